"""Clearance at samples of a motion: a curve to look at, never a certificate."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.report.pose import joint_frames, sphere_centres
from rrnn_opt.scene.shapes import Obstacle

Array = NDArray[np.float64]


def sampled_clearance(
    robot: dict[str, Any], obstacles: Sequence[Obstacle], q: Array
) -> Array | None:
    """Least distance of moving spheres to the obstacles.

    Args:
        robot: robot block of a plan result.
        obstacles: shapes.
        q: postures, (n, nv), rad or m.

    Returns:
        Distances, (n,), m; None without obstacles or moving spheres.
    """
    moving = [s for s in robot.get("spheres", []) if s["joint"] >= 0]
    if not moving or not obstacles:
        return None
    centres, radii = sphere_centres(
        {**robot, "spheres": moving}, joint_frames(robot, q)
    )
    points = centres.reshape(-1, 3).T
    least = np.full(points.shape[1], np.inf)
    for obstacle in obstacles:
        least = np.minimum(least, _distances(obstacle, points))
    distances: Array = (least.reshape(len(q), -1) - radii).min(axis=1)
    return distances


def _distances(obstacle: Obstacle, points: Array) -> Array:
    """Signed distance of points, (3, n), to a shape, (n,)."""
    from rrnn_opt.scene.distance import distance_function

    distance = distance_function(obstacle.kind)(points, obstacle.pack())[0]
    return np.asarray(distance, dtype=float).ravel()
