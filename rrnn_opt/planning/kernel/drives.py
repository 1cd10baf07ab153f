"""The planner's attractions, from SX: to a posture, to a tip position, to a pose."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.formulations.slide import joint_attraction, row, tip_attraction
from rrnn_opt.planning.kernel.function import emitted_function
from rrnn_opt.robot import Robot
from rrnn_opt.robot.tree import JointTree


def tip_jacobian(
    tree: JointTree, moving: tuple[int, ...], axes: ca.SX, origins: ca.SX, tip: ca.SX
) -> ca.SX:
    """Position Jacobian of the tip, ``dp/dq``, (3, nv), m/rad or 1.

    Args:
        tree: the joints.
        moving: indices of the joints that move the tip.
        axes: world axes of the joints, (3, nj).
        origins: world origins of the joints, (3, nj), m.
        tip: p, (3, 1), m.
    """
    mask = ca.SX([float(k in moving) for k in range(tree.nj)])
    eye = ca.SX.eye(3)
    return ca.vertcat(
        *(row(tree, axes, origins, mask, tip, eye[:, i]) for i in range(3))
    )


def _turn_jacobian(tree: JointTree, moving: tuple[int, ...], axes: ca.SX) -> ca.SX:
    """Angular velocity Jacobian of the tip, (3, nv)."""
    columns = [ca.SX.zeros(3) for _ in range(1 + int(max(tree.source)))]
    for k in moving:
        if tree.types[k] != "prismatic":
            columns[int(tree.source[k])] += float(tree.multiplier[k]) * axes[:, k]
    return ca.horzcat(*columns)


def _miss(goal: ca.SX, axes: ca.SX, half: ca.SX, tip: ca.SX) -> ca.SX:
    """From the tip to the nearest point of the goal's region, (3, 1), m."""
    local = axes.T @ (goal - tip)
    return axes @ (local - ca.fmax(-half, ca.fmin(local, half)))


def _turn_error(turn: ca.SX, wanted: ca.SX, free: ca.SX) -> tuple[ca.SX, ca.SX]:
    """Twist towards the wanted axes, (3, 1), and chord 2 sin(angle / 2).

    With all three axes wanted both are means over the three; with a free one
    only that axis has to point the right way, and nothing turns about it.
    """
    weights = [free[i] + (1 - ca.sum1(free)) / 2 for i in range(3)]
    columns = [(turn[:, i], wanted[:, i]) for i in range(3)]
    pairs = list(zip(weights, columns, strict=True))
    twist = sum((c * ca.cross(a, b) for c, (a, b) in pairs), ca.SX(0))
    return twist, ca.sqrt(sum((c * ca.sumsqr(a - b) for c, (a, b) in pairs), ca.SX(0)))


def drive_functions(robot: Robot) -> list[ca.Function]:
    """Attractions: to a posture, to a tip position or region, to a tip pose."""
    return [_to_posture(robot.nv), *_to_tip(robot)]


def _to_posture(nv: int) -> ca.Function:
    q, target, length = ca.SX.sym("q", nv), ca.SX.sym("target", nv), ca.SX.sym("length")
    return emitted_function(
        "k_drive_joint",
        {"q": q, "target": target, "length": length},
        {"w": joint_attraction(q, target, length)},
    )


def _to_tip(robot: Robot) -> list[ca.Function]:
    """To a position, and to a pose with axes about which the tip may turn freely."""
    tree, nj = robot.tree, robot.tree.nj
    moving = tree.ancestors(robot.frame().joint)
    axes, origins = ca.SX.sym("axes", 3, nj), ca.SX.sym("origins", 3, nj)
    tip, turn = ca.SX.sym("tip_position", 3), ca.SX.sym("tip_rotation", 3, 3)
    goal, wanted = ca.SX.sym("position", 3), ca.SX.sym("rotation", 3, 3)
    half, free, length = ca.SX.sym("half", 3), ca.SX.sym("free", 3), ca.SX.sym("length")
    linear = tip_jacobian(tree, moving, axes, origins, tip)
    about, angular = wanted @ free, _turn_jacobian(tree, moving, axes)
    held = angular - about @ (about.T @ angular)
    miss = _miss(goal, wanted, half, tip)
    way = ca.sqrt(ca.sumsqr(miss))
    twist, chord = _turn_error(turn, wanted, free)
    to_pose = tip_attraction(ca.vertcat(linear, held), ca.vertcat(miss, twist), length)
    frame = {"axes": axes, "origins": origins, "tip_position": tip}
    place = {"position": goal, "rotation": wanted, "half": half}
    return [
        emitted_function(
            "k_drive_position",
            {**frame, **place, "length": length},
            {"w": tip_attraction(linear, miss, length), "error": ca.vertcat(way, 0)},
        ),
        emitted_function(
            "k_drive_pose",
            {**frame, "tip_rotation": turn, **place, "free": free, "length": length},
            {"w": to_pose, "error": ca.vertcat(way, chord)},
        ),
    ]
