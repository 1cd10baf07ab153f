"""What a scheme is told of obstacles: gaps and normals at its spheres."""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca
import numpy as np

from rrnn_opt.errors import ProblemError
from rrnn_opt.robot import Kinematics, Robot
from rrnn_opt.robot.tree import Array
from rrnn_opt.scene import PRIMITIVES, Scene

FAR = 100.0
"""Clearance that is told where there is no obstacle, m."""


def default_contacts(robot: Robot) -> tuple[int, ...]:
    """One sphere a moving link: its last."""
    last = {s.link: k for k, s in enumerate(robot.spheres) if s.joint >= 0}
    return tuple(last.values())


def gaps(kin: Kinematics, spheres: Sequence[int], scene: Scene) -> tuple[ca.SX, ca.SX]:
    """Clearance and outward normal at the obstacle nearest to each sphere.

        d_i = min over obstacles of distance(p_i) - radius_i,   n_i = dd_i/dp_i

    Args:
        kin: kinematics of the robot.
        spheres: indices of the robot's spheres.
        scene: obstacles; without any, all spheres are ``FAR`` from a wall.

    Returns:
        Clearances (k, 1), m, and normals (3, k).

    Raises:
        ProblemError: an obstacle has no distance in closed form.
    """
    centres = kin.sphere_centres()
    found = [
        _nearest(centres[:, k], float(kin.robot.spheres[k].radius), scene)
        for k in spheres
    ]
    return ca.vertcat(*[d for d, _ in found]), ca.horzcat(*[n for _, n in found])


def least_clearance(kin: Kinematics, scene: Scene, q: Array) -> float:
    """Least clearance of any moving sphere from any obstacle over postures.

    Args:
        kin: kinematics of the robot.
        scene: obstacles, at least one.
        q: postures, (rows, nv).
    """
    moving = [k for k, s in enumerate(kin.robot.spheres) if s.joint >= 0]
    least = ca.mmin(gaps(kin, moving, scene)[0])
    function = ca.Function("least", [kin.q], [least]).map(len(q))
    return float(np.min(np.asarray(function(q.T))))


def _nearest(centre: ca.SX, radius: float, scene: Scene) -> tuple[ca.SX, ca.SX]:
    """Smallest clearance over the obstacles, and the normal there."""
    best, normal = ca.SX(FAR), ca.SX([1.0, 0.0, 0.0])
    for obstacle in scene:
        if obstacle.kind not in PRIMITIVES:
            message = f"'{obstacle.kind}' has no distance in closed form"
            raise ProblemError("scene.obstacles", message)
        distance, outward = PRIMITIVES[obstacle.kind](centre, ca.SX(obstacle.pack()))
        nearer = distance - radius < best
        normal = ca.if_else(nearer, outward, normal)
        best = ca.fmin(distance - radius, best)
    return best, normal
