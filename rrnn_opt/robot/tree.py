"""What a robot is made of: a tree of joints, limits, frames and spheres."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rrnn_opt.arguments import checked
from rrnn_opt.errors import ShapeError

Index = NDArray[np.int64]
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


def indices(values: ArrayLike) -> Index:
    """A read-only copy of integer indices, (n,)."""
    array = np.array(values, dtype=np.int64)
    array.flags.writeable = False
    return array


@checked(infinite=("lower", "upper"))
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


@checked()
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
        source: index of the coordinate that drives the joint, (nj,).
        multiplier: of the coordinate, (nj,), a ratio.
        offset: rad or m, (nj,).
    """

    parents: Index
    types: tuple[str, ...]
    placements: Array
    axes: Array
    source: Index
    multiplier: Array
    offset: Array

    @property
    def nj(self) -> int:
        """Number of moving joints."""
        return len(self.types)

    def ancestors(self, joint: int) -> tuple[int, ...]:
        """Joints that move joint ``joint``'s frame, root first, itself last.

        Empty for the base (-1).

        Args:
            joint: its number.
        """
        chain: list[int] = []
        while joint != BASE:
            chain.append(joint)
            joint = int(self.parents[joint])
        return tuple(reversed(chain))

    def common_ancestor(self, first: int, second: int) -> int:
        """The last joint that moves both frames (-1 when it is the base).

        Args:
            first: number of a joint.
            second: number of another, or the same.
        """
        common = BASE
        for a, b in zip(self.ancestors(first), self.ancestors(second), strict=False):
            if a != b:
                break
            common = a
        return common


@checked()
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


@checked()
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
