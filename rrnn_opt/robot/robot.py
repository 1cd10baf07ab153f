"""The robot, and the ways to get one: built in, from a URDF, from plain data."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from rrnn_opt.arguments import checked
from rrnn_opt.robot.builtin import builtin
from rrnn_opt.robot.data import RobotData
from rrnn_opt.robot.serial import robot_from_dict, robot_to_dict


@checked()
@dataclass(frozen=True, eq=False)
class Robot(RobotData):
    """A robot arm as data; coordinates are plain joint angles (or metres).

    ``RobotData`` has its fields; built-in robots and loaders make those.
    """

    def to_dict(self) -> dict[str, Any]:
        """The robot as JSON-ready data."""
        return robot_to_dict(self)

    @staticmethod
    def from_dict(data: Mapping[str, Any]) -> Robot:
        """The robot of such data; it knows no frame but its tip.

        Args:
            data: as from ``to_dict``.

        Raises:
            RobotError: an entry is missing or makes no sense.
            NotFiniteError: a number is not finite.
        """
        return _robot(robot_from_dict(data))

    @staticmethod
    def builtin(name: str) -> Robot:
        """A built-in robot: "pa10", "panda", "raven2" or "planar3".

        Raises:
            RobotError: no robot has that name.
        """
        return _robot(builtin(name))

    @staticmethod
    def from_urdf(
        path: str | Path,
        *,
        tip: str | None = None,
        tips: Sequence[str] = (),
        spheres: str | Path | None = None,
        locked: dict[str, float] | None = None,
    ) -> Robot:
        """The chain of a URDF from its root to the frame ``tip``, or to ``tips``.

        Args:
            path: the URDF file.
            tip: end-effector link; without it the last leaf that a joint moves.
            tips: links of several arms that move at once, in place of ``tip``.
            spheres: collision-sphere file; without it the spheres, cylinders
                and boxes of the collision geometry are covered by spheres.
            locked: values of joints that do not move, rad or m.

        Raises:
            RobotError: the file cannot be read, or has no such frame.
        """
        from rrnn_opt.robot.loading.loader import from_urdf

        data = from_urdf(path, tip=tip, tips=tips, spheres=spheres, locked=locked)
        return _robot(data)

    @staticmethod
    def from_pinocchio(model: Any, *, tip: str | None = None) -> Robot:
        """All joints of a ``pin.Model`` as a tree.

        Args:
            model: without free-flyer, its joints of one degree of freedom.
            tip: frame name; the model's last frame without it.

        Raises:
            RobotError: a joint of another type, or no frame ``tip``.
        """
        from rrnn_opt.robot.loading.loader import from_pinocchio

        return _robot(from_pinocchio(model, tip=tip))


def _robot(data: RobotData) -> Robot:
    return Robot(**{field.name: getattr(data, field.name) for field in fields(data)})
