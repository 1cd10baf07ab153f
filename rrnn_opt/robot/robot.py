"""The robot as frozen arrays, and the ways to get one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from rrnn_opt.arguments import checked
from rrnn_opt.errors import RobotError
from rrnn_opt.robot.tree import (
    BASE,
    CONTINUOUS,
    JOINT_TYPES,
    PRISMATIC,
    REVOLUTE,
    Array,
    Frame,
    JointTree,
    Limits,
    Sphere,
    frozen,
)

__all__ = [
    "BASE",
    "CONTINUOUS",
    "JOINT_TYPES",
    "PRISMATIC",
    "REVOLUTE",
    "Array",
    "Frame",
    "JointTree",
    "Limits",
    "Robot",
    "Sphere",
    "frozen",
]


@checked()
@dataclass(frozen=True, eq=False)
class Robot:
    """A robot arm as data; coordinates are plain joint angles (or metres).

    Attributes:
        name: e.g. "pa10".
        joint_names: one a coordinate, nv of them.
        tree: the joints.
        limits: of the coordinates.
        frames: named frames; the end effector is among them.
        tip: name of the end-effector frame.
        spheres: collision spheres.
        self_pairs: pairs of links that are checked against each other.
        cover: what the spheres stand for: {"inflation_m": (least, most)} of
            covers, {"missing": [...]} links with geometry but no spheres.
        source: where the numbers come from.
        licence: licence of the description.
    """

    name: str
    joint_names: tuple[str, ...]
    tree: JointTree
    limits: Limits
    frames: tuple[Frame, ...]
    tip: str
    spheres: tuple[Sphere, ...] = ()
    self_pairs: tuple[tuple[str, str], ...] = ()
    cover: dict[str, Any] = field(default_factory=dict)
    source: str = ""
    licence: str = ""

    @property
    def nv(self) -> int:
        """Number of coordinates."""
        return len(self.joint_names)

    @checked()
    def frame(self, name: str | None = None) -> Frame:
        """The frame of that name; the tip when no name is given.

        Args:
            name: of a frame; None for the tip.

        Raises:
            RobotError: there is no such frame.
        """
        wanted = self.tip if name is None else name
        for candidate in self.frames:
            if candidate.name == wanted:
                return candidate
        known = ", ".join(f.name for f in self.frames[-12:])
        raise RobotError(self.name, f"no frame '{wanted}'; it has {known}")

    def sphere_pairs(self) -> list[tuple[int, int]]:
        """Index pairs of spheres, one for every two spheres of a self pair."""
        of: dict[str, list[int]] = {
            link: [] for pair in self.self_pairs for link in pair
        }
        for index, sphere in enumerate(self.spheres):
            of.setdefault(sphere.link, []).append(index)
        return [(i, j) for a, b in self.self_pairs for i in of[a] for j in of[b]]

    def to_dict(self) -> dict[str, Any]:
        """The robot as JSON-ready data."""
        from rrnn_opt.robot.serial import robot_to_dict

        return robot_to_dict(self)

    @staticmethod
    def builtin(name: str) -> Robot:
        """A built-in robot: "pa10", "panda", "raven2" or "planar3".

        Raises:
            RobotError: no robot has that name.
        """
        from rrnn_opt.robot.builtin import builtin

        return builtin(name)

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
        from rrnn_opt.robot.loading import from_urdf

        return from_urdf(path, tip=tip, tips=tips, spheres=spheres, locked=locked)

    @staticmethod
    def from_pinocchio(model: Any, *, tip: str | None = None) -> Robot:
        """All joints of a ``pin.Model`` as a tree.

        Args:
            model: without free-flyer, its joints of one degree of freedom.
            tip: frame name; the model's last frame without it.

        Raises:
            RobotError: a joint of another type, or no frame ``tip``.
        """
        from rrnn_opt.robot.loading import from_pinocchio

        return from_pinocchio(model, tip=tip)
