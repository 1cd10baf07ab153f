"""Shorter polylines, every new segment of which is proved by the caller."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from rrnn_opt.arguments import checked
from rrnn_opt.motion.path import SAME, Array, Path, sound_path

SegmentIsFree = Callable[[Array, Array], bool]
ATTEMPTS = 100


@checked()
def shortcut(
    waypoints: ArrayLike,
    segment_is_free: SegmentIsFree,
    *,
    rng: np.random.Generator,
    attempts: int = ATTEMPTS,
) -> Array:
    """Replace detours by straight lines that the predicate proves.

    A greedy pass first (from each waypoint to the farthest that can be
    reached, by halving), then random shortcuts between two points anywhere on
    the path.  A part of a proved segment is proved, so only the new segments
    are asked for.

    Args:
        waypoints: (N, nv), every segment proved, rad or m.
        segment_is_free: a proof, not a sample, for (q0, q1).
        rng: source of the random pairs; the same state gives the same path.
        attempts: random pairs to try.

    Returns:
        (M, nv), rad or m, first and last row unchanged, never longer than the input.

    Raises:
        NotFiniteError, ShapeError: malformed input.
    """
    path = Path(np.asarray(waypoints, dtype=np.float64)).without_duplicates()
    path = _greedy(path, segment_is_free)
    for _ in range(attempts):
        if len(path.waypoints) < 3:
            break
        low, high = np.sort(rng.uniform(0.0, path.length, size=2))
        path = _cut(path, float(low), float(high), segment_is_free)
    return path.waypoints.copy()


def _greedy(path: Path, free: SegmentIsFree) -> Path:
    points, kept, here = path.waypoints, [0], 0
    last = len(points) - 1
    while here < last:
        there = last
        while there > here + 1 and not free(points[here], points[there]):
            there = here + (there - here) // 2
        here = there
        kept.append(here)
    return sound_path(points[kept])


def _cut(path: Path, low: float, high: float, free: SegmentIsFree) -> Path:
    """The straight line between two points of the path, if it is shorter."""
    arcs, points = path.arcs, path.waypoints
    first = int(np.searchsorted(arcs, low, side="right"))
    last = int(np.searchsorted(arcs, high, side="left"))
    if last <= first:  # both on one segment
        return path
    a, b = path.at([low, high])
    saved = (high - low) - float(np.linalg.norm(b - a))
    if saved <= SAME or not free(a, b):
        return path
    joined = np.vstack([points[:first], a, b, points[last:]])
    return sound_path(joined).without_duplicates()
