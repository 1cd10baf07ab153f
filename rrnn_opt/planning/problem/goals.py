"""Goals as frozen data: a posture, or a pose of the end-effector frame."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.errors import ProblemError
from rrnn_opt.scene import fields
from rrnn_opt.scene.pose import matrix_from_quaternion

Array = NDArray[np.float64]

TOLERANCE = 1e-3
"""Default of a tip goal's ``tolerance``, m."""
ANGLE_TOLERANCE = 1e-2
"""Default of a tip goal's ``angle_tolerance``, rad."""
JOINT_TOLERANCE = 1e-6
"""Within this every joint of a joint goal is reached, rad or m."""

AXES = ("x", "y", "z")
"""Axes of a goal's own frame, as ``free_axis`` names them."""


@dataclass(frozen=True, eq=False)
class JointGoal:
    """A posture, reached within ``JOINT_TOLERANCE`` in every joint.

    Attributes:
        joints: one value a coordinate, (nv,), rad or m; a continuous joint's
            angle counts modulo one turn.

    Raises:
        ProblemError: not a list of finite numbers.
    """

    joints: Array

    def __post_init__(self) -> None:
        joints = fields.vector(self.joints, None, "joints")
        object.__setattr__(self, "joints", joints)

    def to_dict(self) -> dict[str, Any]:
        """The goal as the problem file writes it."""
        return {"joints": self.joints.tolist()}


@dataclass(frozen=True, eq=False)
class TipGoal:
    """A position of the end-effector frame, with or without an orientation.

    Attributes:
        position: in the base frame, (3,), m.
        quat_xyzw: orientation, (4,), or None where any will do.
        tolerance: largest distance from the position or the region, m.
        angle_tolerance: largest angle from the orientation, rad.
        region: full edges of a box about ``position`` in the goal's own axes,
            (3,), m, any point of which will do; None for the position alone.
        free_axis: axis of the goal's frame about which the end effector may
            turn freely, or None.

    Raises:
        ProblemError: a number is not finite, a tolerance not positive, an edge
            negative, the quaternion not of unit length, or an axis free
            without an orientation.
    """

    position: Array
    quat_xyzw: Array | None = None
    tolerance: float = TOLERANCE
    angle_tolerance: float = ANGLE_TOLERANCE
    region: Array | None = None
    free_axis: str | None = None

    def __post_init__(self) -> None:
        checked = {
            "position": fields.vector(self.position, 3, "position"),
            "tolerance": fields.positive(self.tolerance, "tolerance"),
            "angle_tolerance": fields.positive(self.angle_tolerance, "angle_tolerance"),
        }
        if self.quat_xyzw is not None:
            checked["quat_xyzw"] = fields.unit(self.quat_xyzw, 4, "quat_xyzw")[0]
        if self.region is not None:
            checked["region"] = _edges(self.region)
        if self.free_axis is not None:
            _require_axis(self.free_axis, self.quat_xyzw)
        for key, value in checked.items():
            object.__setattr__(self, key, value)

    @property
    def rotation(self) -> Array:
        """The goal's axes as columns, (3, 3); the base's without a quaternion."""
        if self.quat_xyzw is None:
            return np.eye(3)
        return matrix_from_quaternion(self.quat_xyzw)

    @property
    def half_edges(self) -> Array:
        """Half edges of the region, (3,), m; zeros without one."""
        return np.zeros(3) if self.region is None else 0.5 * self.region

    def distance(self, point: Array) -> float:
        """Distance of a point from the position or the region, m.

        Args:
            point: position of the tip, (3,), m.
        """
        local = self.rotation.T @ (np.asarray(point) - self.position)
        outside = np.maximum(np.abs(local) - self.half_edges, 0.0)
        return float(np.linalg.norm(outside))

    def to_dict(self) -> dict[str, Any]:
        """The goal as the problem file writes it, defaults filled in."""
        data: dict[str, Any] = {
            "position": self.position.tolist(),
            "tolerance": self.tolerance,
        }
        if self.quat_xyzw is not None:
            data["quat_xyzw"] = self.quat_xyzw.tolist()
            data["angle_tolerance"] = self.angle_tolerance
        if self.region is not None:
            data["region"] = {"box": self.region.tolist()}
        if self.free_axis is not None:
            data["free_axis"] = self.free_axis
        return data


def _edges(value: object) -> Array:
    edges = fields.vector(value, 3, "region.box")
    for i, edge in enumerate(edges):
        fields.not_negative(edge, f"region.box[{i}]")
    return edges


def _require_axis(axis: object, quat_xyzw: Array | None) -> None:
    if not isinstance(axis, str) or axis not in AXES:
        raise ProblemError("free_axis", f"must be x, y or z, not {fields.shown(axis)}")
    if quat_xyzw is None:
        raise ProblemError("free_axis", "needs quat_xyzw beside it")


Goal = JointGoal | TipGoal

_OPTIONAL = ("tolerance", "quat_xyzw", "angle_tolerance", "region", "free_axis")
_FIELDS = ("joints", "position", *_OPTIONAL)
_FORMS = ', {"position": [x, y, z]} or {"joints": [..]}'


def goal_name(index: int, count: int) -> str:
    """Name of a goal's field: "goal", or "goal[2]" in a list of several."""
    return "goal" if count == 1 else f"goal[{index}]"


def goals_from_data(data: object) -> tuple[Goal, ...]:
    """The goals of a problem file's ``goal``: one object or a list of them.

    Raises:
        ProblemError: names the field, e.g. ``goal[1].position[2]``.
    """
    given = data if isinstance(data, list | tuple) else [data]
    return tuple(_goal(g, goal_name(i, len(given))) for i, g in enumerate(given))


def _goal(data: object, field: str) -> Goal:
    if not isinstance(data, dict):
        message = f"expected an object{_FORMS}, got {fields.shown(data)}"
        raise ProblemError(field, message)
    for key in data:
        if key not in _FIELDS:
            message = f"is not a known field; {fields.suggestion(key, _FIELDS)}"
            raise ProblemError(fields.join(field, key), message)
    try:
        if "joints" in data:
            return JointGoal(**fields.record(data, "", required=("joints",)))
        return _tip_goal(data)
    except ProblemError as error:
        raise ProblemError(f"{field}.{error.field}", error.message) from None


def _tip_goal(data: dict[Any, Any]) -> TipGoal:
    given = fields.record(data, "", required=("position",), optional=_OPTIONAL)
    for key, wanted in (("quat_xyzw", "a list of 4 numbers"), ("free_axis", "an axis")):
        if key in given and given[key] is None:
            raise ProblemError(key, f"expected {wanted}, got None")
    if "region" in given:
        given["region"] = fields.record(given["region"], "region", required=("box",))[
            "box"
        ]
    if "angle_tolerance" in given and "quat_xyzw" not in given:
        raise ProblemError("angle_tolerance", "needs quat_xyzw beside it")
    return TipGoal(**given)
