"""Polylines in joint space: length, points along them, fewer or more corners."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rrnn_opt.arguments import checked
from rrnn_opt.errors import NotFiniteError, ShapeError

Array = NDArray[np.float64]
SAME = 1e-9
"""Waypoints nearer than this (largest coordinate, rad or m) are one."""
TINY = 1e-300


@checked()
@dataclass(frozen=True, eq=False)
class Path:
    """Waypoints joined by straight lines.

    Attributes:
        waypoints: (N, nv), N >= 1, rad (or m for a prismatic joint).

    Raises:
        ShapeError: not a matrix with a row and a column at least.
        NotFiniteError: a number is NaN or infinite.
    """

    waypoints: Array

    def __post_init__(self) -> None:
        points = np.array(self.waypoints, dtype=np.float64)
        if points.ndim != 2 or not points.size:
            raise ShapeError("waypoints", (1, 1), points.shape)
        if not np.all(np.isfinite(points)):
            raise NotFiniteError("waypoints")
        points.flags.writeable = False
        object.__setattr__(self, "waypoints", points)

    @property
    def start(self) -> Array:
        """First waypoint, (nv,), rad or m."""
        return np.asarray(self.waypoints[0])

    @property
    def goal(self) -> Array:
        """Last waypoint, (nv,), rad or m."""
        return np.asarray(self.waypoints[-1])

    @cached_property
    def arcs(self) -> Array:
        """Euclidean length from the start to each waypoint, (N,), rad or m."""
        steps = np.diff(self.waypoints, axis=0)
        arcs = np.zeros(len(self.waypoints))
        np.cumsum(np.sqrt(np.einsum("ij,ij->i", steps, steps)), out=arcs[1:])
        arcs.flags.writeable = False
        return arcs

    @property
    def length(self) -> float:
        """Euclidean length in joint space, rad or m."""
        return float(self.arcs[-1])

    def at(self, arc: ArrayLike) -> Array:
        """Points at given lengths from the start; beyond the ends, the ends.

        Args:
            arc: lengths, (M,), rad or m.

        Returns:
            (M, nv), rad or m; exactly the first and last waypoint at the ends.
        """
        wanted, arcs = np.asarray(arc, dtype=np.float64), self.arcs
        if len(arcs) == 1:
            return np.repeat(self.waypoints, len(wanted), axis=0)
        piece = np.searchsorted(arcs[1:-1], wanted, side="right")
        first, long = arcs[piece], np.maximum(arcs[piece + 1] - arcs[piece], TINY)
        share = np.clip((wanted - first) / long, 0.0, 1.0)[..., None]
        ends = self.waypoints[piece], self.waypoints[piece + 1]
        between = ends[0] + share * (ends[1] - ends[0])
        return np.asarray(np.where(share >= 1.0, ends[1], between))

    def without_duplicates(self, tolerance: float = SAME) -> Path:
        """The path without waypoints that repeat the one before.

        The start and the goal are kept exactly; two rows remain at least,
        unless the path is a single point.

        Args:
            tolerance: largest joint distance, rad or m, that counts as none.
        """
        steps = np.abs(np.diff(self.waypoints, axis=0))
        if np.all(steps.max(axis=1, initial=0.0) > tolerance):
            return self
        kept = [0]
        for k in range(1, len(self.waypoints)):
            step = np.abs(self.waypoints[k] - self.waypoints[kept[-1]])
            if step.max() > tolerance:
                kept.append(k)
        last = len(self.waypoints) - 1
        if kept[-1] != last:
            if len(kept) > 1:
                kept[-1] = last
            elif np.any(self.goal != self.start):
                kept.append(last)
        return sound_path(self.waypoints[kept])

    def resampled(self, spacing: float) -> Path:
        """Evenly spaced points of the path, both ends exact.

        Corners between the points are cut by half a spacing at most.

        Args:
            spacing: largest distance of neighbours along the path, rad or m.
        """
        pieces = max(1, int(np.ceil(self.length / spacing)))
        return sound_path(self.at(np.linspace(0.0, self.length, pieces + 1)))


def sound_path(waypoints: Array) -> Path:
    """A path of points of another one: they are not looked at again, nor copied.

    Args:
        waypoints: (N, nv), finite; nobody may change them from now on.
    """
    path = object.__new__(Path)
    waypoints.flags.writeable = False
    object.__setattr__(path, "waypoints", waypoints)
    return path
