"""The robot as frozen arrays: a tree of joints, limits, frames and spheres."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rrnn_opt.errors import RobotError, ShapeError

Array = NDArray[np.float64]

REVOLUTE, PRISMATIC, CONTINUOUS = "revolute", "prismatic", "continuous"
JOINT_TYPES = (REVOLUTE, PRISMATIC, CONTINUOUS)
BASE = -1


def frozen(value: ArrayLike, shape: tuple[int, ...], name: str) -> Array:
    """A read-only float copy of ``value``.

    Args:
        value: numbers.
        shape: required shape.
        name: what the numbers are, for the message.

    Returns:
        The array, not writable.

    Raises:
        ShapeError: the shape differs.
    """
    array = np.array(value, dtype=np.float64)
    if array.shape != shape:
        raise ShapeError(name, shape, array.shape)
    array.flags.writeable = False
    return array


@dataclass(frozen=True, eq=False)
class Limits:
    """Joint limits, one number a coordinate.

    Attributes:
        lower: lowest position, (nv,), rad or m; -inf for a continuous joint.
        upper: highest position, (nv,), rad or m; +inf for a continuous joint.
        velocity: largest speed, (nv,), rad/s or m/s.
        acceleration: largest acceleration, (nv,), rad/s2 or m/s2.
    """

    lower: Array
    upper: Array
    velocity: Array
    acceleration: Array


@dataclass(frozen=True, eq=False)
class JointTree:
    """Moving joints in an order in which parents come first.

    A joint's value is ``multiplier * q[source] + offset``; for all but mimic
    joints that is ``q`` itself.  With nj joints and nv <= nj coordinates:

    Attributes:
        parents: index of the parent joint, -1 for the base, (nj,).
        types: "revolute", "prismatic" or "continuous", nj of them.
        placements: pose of the joint frame in its parent joint's frame when
            the joint value is zero, (nj, 4, 4), m.
        axes: unit axis in the joint frame, (nj, 3).
        source: coordinate that drives the joint, (nj,).
        multiplier: (nj,).
        offset: rad or m, (nj,).
    """

    parents: NDArray[np.int64]
    types: tuple[str, ...]
    placements: Array
    axes: Array
    source: NDArray[np.int64]
    multiplier: Array
    offset: Array

    @property
    def nj(self) -> int:
        """Number of moving joints."""
        return len(self.types)

    def ancestors(self, joint: int) -> tuple[int, ...]:
        """Joints that move joint ``joint``'s frame, root first, itself last.

        Empty for the base (-1).
        """
        chain: list[int] = []
        while joint != BASE:
            chain.append(joint)
            joint = int(self.parents[joint])
        return tuple(reversed(chain))

    def common_ancestor(self, first: int, second: int) -> int:
        """The last joint that moves both frames (-1 when it is the base)."""
        common = BASE
        for a, b in zip(self.ancestors(first), self.ancestors(second), strict=False):
            if a != b:
                break
            common = a
        return common


@dataclass(frozen=True, eq=False)
class Frame:
    """A named frame fixed to a moving joint (or to the base, -1).

    Attributes:
        name: unique name.
        joint: joint whose frame carries it, -1 for the base.
        placement: its pose in that joint's frame, (4, 4), m.
    """

    name: str
    joint: int
    placement: Array


@dataclass(frozen=True, eq=False)
class Sphere:
    """A collision sphere.

    Attributes:
        link: body it belongs to; self pairs name bodies.
        joint: joint whose frame carries it, -1 for the base.
        center: in that joint's frame, (3,), m.
        radius: m.
    """

    link: str
    joint: int
    center: Array
    radius: float


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

    def frame(self, name: str | None = None) -> Frame:
        """The frame of that name; the tip when no name is given.

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
        spheres: str | Path | None = None,
        locked: dict[str, float] | None = None,
    ) -> Robot:
        """The chain of a URDF from its root to the frame ``tip``.

        Args:
            path: the URDF file.
            tip: end-effector link; without it the last leaf that a joint moves.
            spheres: collision-sphere file; without it the spheres, cylinders
                and boxes of the collision geometry are covered by spheres.
            locked: values of joints that do not move, rad or m.

        Raises:
            RobotError: the file cannot be read, or has no such frame.
        """
        from rrnn_opt.robot.loading import from_urdf

        return from_urdf(path, tip=tip, spheres=spheres, locked=locked)

    @staticmethod
    def from_pinocchio(model: Any, *, tip: str | None = None) -> Robot:
        """All joints of a ``pin.Model`` as a tree.

        Raises:
            RobotError: a joint of another type, or no frame ``tip``.
        """
        from rrnn_opt.robot.loading import from_pinocchio

        return from_pinocchio(model, tip=tip)
