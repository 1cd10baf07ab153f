"""Goals as frozen data: a posture, or a pose of the end-effector frame."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.errors import ProblemError
from rrnn_opt.scene import fields

Array = NDArray[np.float64]

TOLERANCE = 1e-3
"""Default of a tip goal's ``tolerance``, m."""
ANGLE_TOLERANCE = 1e-2
"""Default of a tip goal's ``angle_tolerance``, rad."""
JOINT_TOLERANCE = 1e-6
"""Within this every joint of a joint goal is reached, rad or m."""

LATER = ("region", "free_axis")
"""Fields of a tip goal that this version does not read."""


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
        tolerance: largest distance from the position, m.
        angle_tolerance: largest angle from the orientation, rad.

    Raises:
        ProblemError: a number is not finite, a tolerance not positive, or the
            quaternion not of unit length.
    """

    position: Array
    quat_xyzw: Array | None = None
    tolerance: float = TOLERANCE
    angle_tolerance: float = ANGLE_TOLERANCE

    def __post_init__(self) -> None:
        checked = {
            "position": fields.vector(self.position, 3, "position"),
            "tolerance": fields.positive(self.tolerance, "tolerance"),
            "angle_tolerance": fields.positive(self.angle_tolerance, "angle_tolerance"),
        }
        if self.quat_xyzw is not None:
            checked["quat_xyzw"] = fields.unit(self.quat_xyzw, 4, "quat_xyzw")[0]
        for key, value in checked.items():
            object.__setattr__(self, key, value)

    def to_dict(self) -> dict[str, Any]:
        """The goal as the problem file writes it, defaults filled in."""
        data = {"position": self.position.tolist(), "tolerance": self.tolerance}
        if self.quat_xyzw is not None:
            data["quat_xyzw"] = self.quat_xyzw.tolist()
            data["angle_tolerance"] = self.angle_tolerance
        return data


Goal = JointGoal | TipGoal


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
        raise ProblemError(field, f"expected an object, got {fields.shown(data)}")
    for key in LATER:
        if key in data:
            message = "this version does not support it; leave it out"
            raise ProblemError(f"{field}.{key}", message)
    try:
        if "joints" in data:
            return JointGoal(**fields.record(data, "", required=("joints",)))
        return _tip_goal(data)
    except ProblemError as error:
        raise ProblemError(f"{field}.{error.field}", error.message) from None


def _tip_goal(data: dict[Any, Any]) -> TipGoal:
    optional = ("tolerance", "quat_xyzw", "angle_tolerance")
    given = fields.record(data, "", required=("position",), optional=optional)
    if "quat_xyzw" in given and given["quat_xyzw"] is None:
        raise ProblemError("quat_xyzw", "expected a list of 4 numbers, got None")
    if "angle_tolerance" in given and "quat_xyzw" not in given:
        raise ProblemError("angle_tolerance", "needs quat_xyzw beside it")
    return TipGoal(**given)
