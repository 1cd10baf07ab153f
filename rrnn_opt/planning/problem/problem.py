"""The planning problem: robot, start, goals and scene, checked when it is built."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import KW_ONLY, dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.arguments import checked
from rrnn_opt.errors import ProblemError, RobotError
from rrnn_opt.files import read_json
from rrnn_opt.planning.problem.attached import (
    Attached,
    attached_from_list,
    with_attached,
)
from rrnn_opt.planning.problem.goals import Goal, JointGoal, goal_name, goals_from_data
from rrnn_opt.planning.problem.named_robot import locked_joints, named_robot
from rrnn_opt.robot.robot import Robot
from rrnn_opt.scene import fields
from rrnn_opt.scene.broad import BroadPhase, broad_phase
from rrnn_opt.scene.reading import scene_from_list
from rrnn_opt.scene.scene import Scene

Array = NDArray[np.float64]

_TURN = 2.0 * np.pi
_REQUIRED = ("robot", "start", "goal")
_OPTIONAL = ("name", "frame", "spheres", "locked", "obstacles", "attached", "margin")


@checked(skip=("goals", "margin"))
@dataclass(frozen=True, eq=False)
class Problem:
    """From ``start`` to any one of ``goals`` among the obstacles of ``scene``.

    Attributes:
        robot: the arm; its tip is ``frame``.
        start: joint values, (nv,), rad or m; inside the limits.
        goals: one or more; any will do (a single one need not be a tuple).
        scene: the obstacles.
        margin: clearance to keep from obstacles, m, zero or more.
        frame: frame that tip goals speak of; the robot's tip without one.
        robot_ref: robot as the problem file names it.
        spheres_ref: sphere file as the problem file names it, or "".
        locked: values of joints of a URDF that do not move, rad or m.
        attached: objects that move with frames of the robot.
        name: for reports, may be empty.

    Raises:
        ProblemError: names the field that is not valid.
    """

    robot: Robot
    start: Array
    _: KW_ONLY
    goals: tuple[Goal, ...]
    scene: Scene = field(default_factory=Scene)
    margin: float = 0.0
    frame: str = ""
    robot_ref: str = ""
    spheres_ref: str = ""
    locked: Mapping[str, float] = field(default_factory=dict)
    attached: tuple[Attached, ...] = ()
    name: str = ""

    def __post_init__(self) -> None:
        checked: dict[str, Any] = {
            "start": _posture(self.robot, self.start, "start"),
            "goals": _goals(self.goals),
            "margin": fields.not_negative(self.margin, "margin"),
            "frame": _frame(self.robot, self.frame),
            "robot_ref": self.robot_ref or self.robot.name,
            "locked": dict(self.locked),
        }
        robot = replace(self.robot, tip=checked["frame"])
        _require_spheres(robot)
        checked["attached"] = tuple(self.attached)
        checked["robot"] = with_attached(robot, checked["attached"])
        for key, value in checked.items():
            object.__setattr__(self, key, value)
        _require_inside(self.robot, self.start, "start")
        _require_goals(self.robot, self.goals)

    @cached_property
    def solids(self) -> BroadPhase:
        """The scene's solids and the tree over them, for the runtime."""
        return broad_phase(self.scene)

    @staticmethod
    def load(path: str | Path) -> Problem:
        """The problem that a file holds; paths in it start at its folder.

        Args:
            path: problem file (JSON).

        Raises:
            DocumentError: the file is no JSON document.
            ProblemError: names the field that is not valid.
            RobotError: the robot's own files cannot be used.
        """
        data = read_json(path)
        return Problem.from_dict(data, base_dir=Path(path).parent)

    @staticmethod
    def from_dict(data: object, base_dir: str | Path = ".") -> Problem:
        """The problem in the problem file's form.

        Args:
            data: the document, as read from JSON.
            base_dir: folder at which relative paths start.

        Raises:
            ProblemError: names the field that is not valid.
            RobotError: the robot's own files cannot be used.
        """
        given = fields.record(data, "", required=_REQUIRED, optional=_OPTIONAL)
        optional = ("name", "frame", "spheres")
        texts = {key: fields.text(given[key], key) for key in optional if key in given}
        locked = locked_joints(given.get("locked", {}))
        # what is cheap to refuse is refused before a robot is loaded
        goals = goals_from_data(given["goal"])
        scene = scene_from_list(given.get("obstacles", []), base_dir=base_dir)
        attached = attached_from_list(given.get("attached", []), base_dir=base_dir)
        fields.vector(given["start"], None, "start")
        ref = fields.text(given["robot"], "robot")
        return Problem(
            named_robot(ref, Path(base_dir), texts, locked),
            given["start"],
            goals=goals,
            scene=scene,
            margin=given.get("margin", 0.0),
            frame=texts.get("frame", ""),
            robot_ref=ref,
            spheres_ref=texts.get("spheres", ""),
            locked=locked,
            attached=attached,
            name=texts.get("name", ""),
        )

    def to_dict(self) -> dict[str, Any]:
        """The problem file's form with the defaults filled in."""
        goals = [goal.to_dict() for goal in self.goals]
        named = {"name": self.name, "spheres": self.spheres_ref}
        return {
            **{key: value for key, value in named.items() if value},
            "robot": self.robot_ref,
            "frame": self.frame,
            "locked": dict(self.locked),
            "start": self.start.tolist(),
            "goal": goals[0] if len(goals) == 1 else goals,
            "obstacles": self.scene.to_dict(),
            "attached": [body.to_dict() for body in self.attached],
            "margin": self.margin,
        }


def _goals(given: object) -> tuple[Any, ...]:
    """A tuple of what may be one goal or several."""
    return tuple(given) if isinstance(given, list | tuple) else (given,)


def _frame(robot: Robot, name: str) -> str:
    try:
        return robot.frame(name or None).name
    except RobotError as error:
        raise ProblemError("frame", str(error)) from None


def _require_spheres(robot: Robot) -> None:
    """Refuse a robot whose body, or part of it, nothing stands for."""
    missing = robot.cover.get("missing", ())
    if robot.spheres and not missing:
        return
    lacks = "collision spheres"
    if robot.spheres:
        others = f" and {len(missing) - 1} more" if len(missing) > 1 else ""
        lacks += f" for the mesh of link '{missing[0]}'{others}"
    message = (
        f"'{robot.name}' has no {lacks}; make a sphere file with "
        '`rrnn spheres URDF --out FILE` and name it under "spheres"'
    )
    raise ProblemError("robot", message)


def _posture(robot: Robot, given: object, field: str) -> Array:
    """A value for each joint; the message of a wrong count names the joints."""
    try:
        return fields.vector(given, robot.nv, field)
    except ProblemError as error:
        if error.field != field:
            raise
        message = f"{error.message}; one for each of {', '.join(robot.joint_names)}"
        raise ProblemError(field, message) from None


def _require_inside(robot: Robot, joints: Array, field: str) -> None:
    limits = zip(robot.limits.lower, robot.limits.upper, strict=True)
    for k, (low, high) in enumerate(limits):
        value = float(joints[k])
        if not low <= value <= high:
            bounds = f"its limits [{float(low)!r}, {float(high)!r}]"
            message = f"joint '{robot.joint_names[k]}' at {value!r} is outside {bounds}"
            if abs(value) > _TURN:
                message += "; angles are radians, lengths metres"
            raise ProblemError(f"{field}[{k}]", message)


def _require_goals(robot: Robot, goals: tuple[Goal, ...]) -> None:
    if not goals:
        raise ProblemError("goal", "needs at least one goal")
    for index, goal in enumerate(goals):
        if not isinstance(goal, Goal):
            message = f"expected a JointGoal or TipGoal, got {fields.shown(goal)}"
            raise ProblemError(goal_name(index, len(goals)), message)
        if isinstance(goal, JointGoal):
            name = f"{goal_name(index, len(goals))}.joints"
            _posture(robot, goal.joints, name)
            _require_inside(robot, goal.joints, name)
