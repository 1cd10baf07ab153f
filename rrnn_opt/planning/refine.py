"""A better path than the first one found: slides along it, and other searches."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.motion import shortcut
from rrnn_opt.planning.runtime_library import Search
from rrnn_opt.planning.settings import RandomRnn

Array = NDArray[np.float64]
NewSearch = Callable[[int], Search]
STRAIGHT_SHORTCUTS = 20


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
    improve_s: float = 0.0,
) -> Refined:
    """The shortest of several paths, each shortened by slides, then straightened.

    Searches after the first get twice its explorations and 20 more, so that a
    problem that was easy stays fast and no clock decides the result.  With
    ``improve_s`` this goes on, a search and slides along the best path in turn,
    until so many seconds are spent.

    Args:
        first: a search that found a path.
        new_search: another search of the same problem, by its number 1, 2, ...
        settings: numbers of searches and slides.
        seed: of the straight shortcuts.
        improve_s: seconds to go on after the settings' rounds.

    Returns:
        The path, every segment proved, and what it took.
    """
    counts, raw = first.counts(), first.path()
    budget = 2 * (counts.random + counts.heuristic) + 20
    best = first.shorten(raw, settings.shorten_slides)
    rounds, end = 0, time.perf_counter() + improve_s
    while rounds < settings.refinements or time.perf_counter() < end:
        rounds += 1
        path = _another(new_search(rounds), budget, settings.shorten_slides)
        best = best if path is None else min(best, path, key=length)
        if rounds > settings.refinements:
            best = first.shorten(best, settings.shorten_slides)
    rng = np.random.default_rng([seed, 1])
    clear = settings.steering_margin
    straight = shortcut(
        best,
        lambda a, b: first.segment_free(a, b, clearance=clear),
        rng=rng,
        attempts=STRAIGHT_SHORTCUTS,
    )
    return Refined(straight, rounds, length(raw), length(straight))


def _another(search: Search, budget: int, slides: int) -> Array | None:
    """The shortened path of another search, or None when it found none."""
    with search as other:
        status = "paused"
        while status == "paused":
            status = other.run(budget, 1.0)
        return other.shorten(other.path(), slides) if status == "solved" else None
