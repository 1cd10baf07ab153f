"""Polylines in joint space: length, points along them, fewer or more corners."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rrnn_opt.errors import NotFiniteError, ShapeError

Array = NDArray[np.float64]
SAME = 1e-9
"""Waypoints nearer than this (largest coordinate, rad or m) are one."""


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
        """First waypoint, (nv,)."""
        return np.asarray(self.waypoints[0])

    @property
    def goal(self) -> Array:
        """Last waypoint, (nv,)."""
        return np.asarray(self.waypoints[-1])

    @property
    def arcs(self) -> Array:
        """Euclidean length from the start to each waypoint, (N,)."""
        steps = np.linalg.norm(np.diff(self.waypoints, axis=0), axis=1)
        return np.concatenate([[0.0], np.cumsum(steps)])

    @property
    def length(self) -> float:
        """Euclidean length in joint space."""
        return float(self.arcs[-1])

    def at(self, arc: ArrayLike) -> Array:
        """Points at given lengths from the start; beyond the ends, the ends.

        Args:
            arc: (M,).

        Returns:
            (M, nv); exactly the first and last waypoint at the ends.
        """
        wanted, arcs = np.asarray(arc, dtype=np.float64), self.arcs
        columns = [np.interp(wanted, arcs, column) for column in self.waypoints.T]
        return np.stack(columns, axis=-1)

    def without_duplicates(self, tolerance: float = SAME) -> Path:
        """The path without waypoints that repeat the one before.

        The start and the goal are kept exactly; two rows remain at least,
        unless the path is a single point.
        """
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
        return Path(self.waypoints[kept])

    def resampled(self, spacing: float) -> Path:
        """Evenly spaced points of the path, both ends exact.

        Corners between the points are cut by half a spacing at most.

        Args:
            spacing: largest distance of neighbours along the path, rad or m.
        """
        pieces = max(1, int(np.ceil(self.length / spacing)))
        return Path(self.at(np.linspace(0.0, self.length, pieces + 1)))
