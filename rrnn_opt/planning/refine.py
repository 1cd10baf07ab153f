"""A better path than the first one found: slides along it, and other searches."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.motion import shortcut
from rrnn_opt.planning.runtime_library import Search
from rrnn_opt.planning.settings import RandomRnn

Array = NDArray[np.float64]
NewSearch = Callable[[int], Search]
STRAIGHT_SHORTCUTS = 20


def length(path: Array) -> float:
    """Length of a polyline in joint space, rad or m."""
    return float(np.sum(np.linalg.norm(np.diff(path, axis=0), axis=1)))


def refine(
    first: Search, new_search: NewSearch, settings: RandomRnn, seed: int
) -> Array:
    """The shortest of several paths, each shortened by slides, then straightened.

    Searches after the first get twice its explorations and 20 more, so that a
    problem that was easy stays fast and no clock decides the result.

    Args:
        first: a search that found a path.
        new_search: another search of the same problem, by its number 1, 2, ...
        settings: numbers of searches and slides.
        seed: of the straight shortcuts.

    Returns:
        Waypoints, (N, nv), every segment proved.
    """
    counts, raw = first.counts(), first.path()
    budget = 2 * (counts.random + counts.heuristic) + 20
    best = first.shorten(raw, settings.shorten_slides)
    for number in range(1, settings.refinements + 1):
        with new_search(number) as other:
            status = "paused"
            while status == "paused":
                status = other.run(budget, 1.0)
            if status == "solved":
                path = other.shorten(other.path(), settings.shorten_slides)
                best = min(best, path, key=length)
    rng = np.random.default_rng([seed, 1])
    clear = settings.steering_margin
    return shortcut(
        best,
        lambda a, b: first.segment_free(a, b, clearance=clear),
        rng=rng,
        attempts=STRAIGHT_SHORTCUTS,
    )
