"""Clearance at samples of a motion: a curve to look at, never a certificate."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.report.plan.pose import joint_frames, sphere_centres
from rrnn_opt.scene.shapes import Obstacle

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Approach:
    """Where a motion comes nearest to an obstacle, among its samples.

    Attributes:
        sample: index of the sample.
        obstacle: index of the obstacle.
        link: name of the link that comes near.
        distance: m; negative inside.
        ends: on the link's sphere and on the obstacle, (2, 3), m.
    """

    sample: int
    obstacle: int
    link: str
    distance: float
    ends: Array


@dataclass(frozen=True, eq=False)
class Clearance:
    """Least distances of moving spheres to the obstacles.

    Attributes:
        distance: at each sample, (n,), m.
        closest: where the least of them is.
    """

    distance: Array
    closest: Approach


def sampled_clearance(
    robot: dict[str, Any], obstacles: Sequence[Obstacle], q: Array
) -> Clearance | None:
    """Least distance of moving spheres to the obstacles.

    Args:
        robot: robot block of a plan result.
        obstacles: shapes.
        q: postures, (n, nv), rad or m.

    Returns:
        The distances; None without obstacles or moving spheres.
    """
    moving = [s for s in robot.get("spheres", []) if s["joint"] >= 0]
    if not moving or not obstacles:
        return None
    centres, radii = sphere_centres(
        {**robot, "spheres": moving}, joint_frames(robot, q)
    )
    points = centres.reshape(-1, 3).T
    away = np.stack([_distances(obstacle, points)[0] for obstacle in obstacles])
    gaps = away.reshape(len(obstacles), len(q), -1) - radii
    least = np.unravel_index(int(np.argmin(gaps)), gaps.shape)
    nearest, sample, sphere = (int(index) for index in least)
    centre = centres[sample, sphere]
    d, normal = _distances(obstacles[nearest], centre[:, None])
    ends = [centre - radii[sphere] * normal[:, 0], centre - d[0] * normal[:, 0]]
    closest = Approach(
        sample=sample,
        obstacle=nearest,
        link=str(moving[sphere].get("link", "")),
        distance=float(gaps[nearest, sample, sphere]),
        ends=np.stack(ends),
    )
    return Clearance(gaps.min(axis=(0, 2)), closest)


def _distances(obstacle: Obstacle, points: Array) -> tuple[Array, Array]:
    """Signed distance and outward normal of points, (3, n), to a shape."""
    from rrnn_opt.scene.distance import distance_function

    distance, normal = distance_function(obstacle.kind)(points, obstacle.pack())
    return np.asarray(distance, dtype=float).ravel(), np.asarray(normal, dtype=float)
