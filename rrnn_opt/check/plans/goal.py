"""How far the end of a motion is from its goal."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from rrnn_opt.check.plans import reading
from rrnn_opt.check.plans.reading import Array, get
from rrnn_opt.check.plans.robot.kinematics import tip_pose
from rrnn_opt.check.plans.robot.model import Model
from rrnn_opt.errors import DocumentError

JOINT_TOLERANCE = 1e-6
POSITION_TOLERANCE = 1e-3
ANGLE_TOLERANCE = 1e-2
ROUNDING = 1e-12


class GoalError(NamedTuple):
    """Distance from one goal.

    Attributes:
        error: m for a position, rad for joints.
        angle: rad, None when no orientation was asked for.
        reached: both are within their tolerances.
    """

    error: float
    angle: float | None
    reached: bool


def nearest_goal(model: Model, goal: Any, q: Array) -> GoalError:
    """The best of the goals (any one will do) at the last configuration.

    Args:
        model: the robot.
        goal: "goal" of the problem, one object or a list of them.
        q: last row, (nv,).

    Raises:
        DocumentError: a goal is malformed.
    """
    goals = list(goal) if isinstance(goal, list | tuple) else [goal]
    if not goals:
        raise DocumentError("problem.goal", "must not be empty")
    found = [_one(model, g, q, k) for k, g in enumerate(goals)]
    return min(found, key=lambda e: (not e.reached, e.error, e.angle or 0.0))


def _one(model: Model, goal: Any, q: Array, k: int) -> GoalError:
    name = f"problem.goal[{k}]"
    entry = reading.mapping(goal, name)
    if entry.get("joints") is not None:
        return _joints(model, entry["joints"], q, f"{name}.joints")
    rotation, position = tip_pose(model, q)
    wanted = reading.numbers(get(entry, "position", name), (3,), f"{name}.position")
    turned = entry.get("quat_xyzw")
    frame = np.eye(3)
    if turned is not None:
        frame = reading.quaternion(turned, f"{name}.quat_xyzw")
    away = np.abs(frame.T @ (position - wanted)) - _region(entry, name)
    error = float(np.linalg.norm(np.maximum(away, 0.0)))
    kept = error <= _tolerance(entry, "tolerance", POSITION_TOLERANCE, name)
    angle = None
    if turned is not None:
        angle = _angle(frame, rotation, entry.get("free_axis"), name)
        kept &= angle <= _tolerance(entry, "angle_tolerance", ANGLE_TOLERANCE, name)
    return GoalError(error, angle, kept)


def _joints(model: Model, joints: Any, q: Array, name: str) -> GoalError:
    away = q - reading.numbers(joints, (model.nv,), name)
    turns = 2 * np.pi * np.round(away / (2 * np.pi))
    away = np.where(model.continuous, away - turns, away)
    error = float(np.abs(away).max())
    return GoalError(error, None, error <= JOINT_TOLERANCE + ROUNDING)


def _region(entry: Mapping[str, Any], name: str) -> Array:
    """Half edges of the box in which any position will do, in goal axes."""
    region = entry.get("region")
    if region is None:
        return np.zeros(3)
    box = reading.mapping(region, f"{name}.region")
    edges = get(box, "box", f"{name}.region")
    half = reading.numbers(edges, (3,), f"{name}.region.box") / 2
    if np.any(half < 0):
        raise DocumentError(f"{name}.region.box", "must not be negative")
    return half


def _tolerance(entry: Mapping[str, Any], key: str, default: float, name: str) -> float:
    value = entry.get(key)
    if value is None:
        return default + ROUNDING
    return reading.positive(value, f"{name}.{key}") * (1 + 1e-9) + ROUNDING


def _angle(wanted: Array, rotation: Array, free: Any, name: str) -> float:
    if free is not None:
        if free not in ("x", "y", "z"):
            raise DocumentError(f"{name}.free_axis", "must be x, y or z")
        k = "xyz".index(free)
        a, b = wanted[:, k], rotation[:, k]
        return float(np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b))
    turn = wanted.T @ rotation
    vee = np.array(
        [turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]
    )
    return float(np.arctan2(np.linalg.norm(vee), np.trace(turn) - 1.0))
