"""Obstacle rows that a controller computes itself, added to any velocity scheme."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import casadi as ca
import numpy as np

from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.contacts import contacts_of
from rrnn_opt.formulations.task import require_not_negative, require_positive
from rrnn_opt.robot import Kinematics
from rrnn_opt.robot.reach import reach
from rrnn_opt.symbolic import Symbol

NEAREST = 1e-6
"""Distance of centres, m, below which a normal has no direction and is 0."""


def with_obstacles(
    form: Formulation,
    kin: Kinematics,
    *,
    points: Sequence[int],
    obstacles: int,
    gamma: float = 5.0,
    safe: float = 0.02,
) -> Formulation:
    """A velocity scheme that keeps K robot spheres off M obstacle spheres.

    For every sphere i of the robot and obstacle k, the row of ``clearance_rows``

        n'J_i u >= -gamma (d - d_safe),   n = (r_i - o_k) / |r_i - o_k|,
        d = |r_i - o_k| - radius_i - radius_k,

    with normal and clearance computed from q and the obstacle: the caller
    gives centres and radii only.  An obstacle that is not there is given a
    centre far away; the row is then never active.

    Args:
        form: with joint velocities in front of its decision.
        kin: kinematics that it was made with.
        points: index of the robot's sphere at each control point.
        obstacles: M.
        gamma: rate at which a clearance may shrink, 1/s.
        safe: d_safe, m.

    Returns:
        ``form`` with K M inequality rows more, control point by control point,
        and the parameter ``obstacles`` (4, M): centre and radius, m.

    Raises:
        RrnnError: the scheme is of another level, no such sphere, no control
            point or obstacle, or a setting that is not positive.

    Source:
        Velocity damper of B. Faverjon and P. Tournassoud, IEEE Int. Conf.
        Robotics and Automation, 1987, as in ``clearance_rows``.
    """
    require_positive(gamma=gamma)
    require_not_negative(safe=safe)
    if form.level != "velocity":
        raise RrnnError(
            f"{form.name}: obstacle rows speak of joint velocities, not {form.level}"
        )
    if obstacles < 1 or not points:
        raise RrnnError("obstacles: give at least one control point and one obstacle")
    found = contacts_of(kin, points)
    meaning = "spheres to keep off: centre, then radius"
    given = Symbol.matrix("obstacles", (4, obstacles), "m", meaning)
    velocity = form.decision.sx[: kin.robot.nv]
    centres = kin.sphere_centres()
    rows = []
    for index, jacobian in zip(points, found.jacobians, strict=True):
        for k in range(obstacles):
            away = centres[:, index] - given.sx[:3, k]
            distance = ca.sqrt(ca.sumsqr(away))
            radii = float(kin.robot.spheres[index].radius) + given.sx[3, k]
            speed = ca.dot(away / ca.fmax(distance, NEAREST), jacobian @ velocity)
            rows.append(-speed - gamma * (distance - radii - safe))
    return replace(
        form,
        name=f"{form.name}_with_obstacles",
        parameters=(*form.parameters, given),
        inequalities=ca.vertcat(form.inequalities, *rows),
    )


def row_bound(kin: Kinematics, points: Sequence[int], obstacles: int) -> float:
    """Upper bound of the norm |G|_2 of the rows of ``with_obstacles``.

    A row is n'J_i with |n| <= 1, and coordinate j moves sphere i at most R_ij
    a radian (or metre) wherever the arm is inside its position limits, so
    |G|_2^2 <= M sum_i sum_j R_ij^2.

    Args:
        kin: kinematics of the robot.
        points: index of the robot's sphere at each control point.
        obstacles: M.

    Raises:
        RobotError: a prismatic joint that a revolute one carries is unlimited.
    """
    tree, levers = kin.robot.tree, reach(kin.robot)[:, list(points)]
    total = np.zeros((kin.robot.nv, len(points)))
    for joint, lever in enumerate(levers):
        total[int(tree.source[joint])] += abs(float(tree.multiplier[joint])) * lever
    return float(np.sqrt(obstacles * np.sum(np.square(total))) * (1.0 + 1e-9))
