"""A better path than the first one found: slides along it, and other searches."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.motion import shortcut
from rrnn_opt.planning.search.library import SLICE_S, Search
from rrnn_opt.planning.settings.random_rnn import RandomRnn

Array = NDArray[np.float64]
NewSearch = Callable[[int], Search]
STRAIGHT_SHORTCUTS = 20
NEARLY = 1.02
"""A path at most so many times as long as the shortest is not worth a search."""


@dataclass(frozen=True, eq=False)
class Refined:
    """A refined path.

    Attributes:
        path: waypoints, (N, nv).
        rounds: searches after the first.
        first_length: of the path as found, rad or m in joint space.
        length: of the path now.
    """

    path: Array
    rounds: int
    first_length: float
    length: float


def length(path: Array) -> float:
    """Length of a polyline in joint space, rad or m."""
    return float(np.sum(np.linalg.norm(np.diff(path, axis=0), axis=1)))


def refine(
    first: Search,
    new_search: NewSearch,
    settings: RandomRnn,
    seed: int,
    *,
    shortest: float = 0.0,
    improve_s: float = 0.0,
) -> Refined:
    """The shortest of several paths, each shortened by slides, then straightened.

    Searches after the first get twice its explorations and 20 more, so that a
    problem that was easy stays fast and no clock decides the result.  They end
    early where they cannot help: the path is nearly the shortest that there can
    be, or a search finds what the first one found (its first slide draws nothing
    at random, so the others would, too).  With ``improve_s`` they go on, a search
    and slides along the best path in turn, until so many seconds are spent.

    Args:
        first: a search that found a path.
        new_search: another search of the same problem, by its number 1, 2, ...
        settings: numbers of searches and slides.
        seed: of the straight shortcuts.
        shortest: no path can be shorter, rad or m; 0 where that is not known.
        improve_s: seconds to go on after the settings' rounds.

    Returns:
        The path, every segment proved, and what it took.
    """
    raw, end = first.path(), time.perf_counter() + improve_s
    best, rounds = _searched(first, raw, new_search, settings, shortest, end)
    clear = settings.steering_margin
    straight = shortcut(
        best,
        lambda a, b: first.segment_free(a, b, extra=clear),
        rng=np.random.default_rng([seed, 1]),
        attempts=0 if _nearly_straight(best) else STRAIGHT_SHORTCUTS,
    )
    return Refined(straight, rounds, length(raw), length(straight))


def _searched(
    first: Search,
    raw: Array,
    new_search: NewSearch,
    settings: RandomRnn,
    shortest: float,
    end: float,
) -> tuple[Array, int]:
    """The shortest path of several searches, and how many there were."""
    counts, slides = first.counts(), settings.shorten_slides
    budget = 2 * (counts.random + counts.heuristic) + 20
    best, rounds, new = _shortened(first, raw, slides, np.inf), 0, True
    while True:
        hope = new and length(best) > NEARLY * shortest
        within = rounds < settings.refinements
        if not (hope and within) and time.perf_counter() >= end:
            return best, rounds
        rounds += 1
        with new_search(rounds) as search:
            path = _found(search, budget, np.inf if within else end)
            if path is not None:
                new = not np.array_equal(path, raw)
                path = _shortened(search, path, slides, length(best))
                best = min(best, path, key=length)
        if not within:
            best = first.shorten(best, slides)


def _found(search: Search, budget: int, end: float) -> Array | None:
    """The path of a search, or None when it found none before the clock shows end."""
    status = "paused"
    while status == "paused":
        left = end - time.perf_counter()
        status = search.run(budget, min(SLICE_S, left), left)
    return search.path() if status == "solved" else None


def _shortened(search: Search, path: Array, slides: int, best: float) -> Array:
    """The path after some slides, or as it is where they cannot help.

    No path between its ends is shorter than their distance: slides are left out
    where that is the path's length already, or no less than ``best``.
    """
    if _apart(path) >= best or _nearly_straight(path):
        return path
    return search.shorten(path, slides)


def _apart(path: Array) -> float:
    return float(np.linalg.norm(path[-1] - path[0]))


def _nearly_straight(path: Array) -> bool:
    return length(path) <= NEARLY * _apart(path)
