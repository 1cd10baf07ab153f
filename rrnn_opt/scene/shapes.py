"""Obstacles as frozen data; what is not a solid is refused when it is built.

Positions and sizes in metres, quaternions xyzw.  The axis of cylinders and
capsules is their local z; a capsule's length is between its sphere centres.
``pack()`` gives the 16 numbers that the distance expressions read: rotation
(column-major, 9), position (3), dimensions (3), zero.
"""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.scene import fields as check
from rrnn_opt.scene.pose import IDENTITY, frame_around, matrix_from_quaternion

Array = NDArray[np.float64]

PACKED = 16
"""Numbers that one packed shape takes."""


def _origin() -> Array:
    return np.zeros(3)


def _upright() -> Array:
    return np.array(IDENTITY)


def _checked(shape: object, **values: object) -> None:
    for key, value in values.items():
        object.__setattr__(shape, key, value)


def _pose(shape: Box | _Round) -> dict[str, object]:
    return {
        "name": check.text(shape.name, "name"),
        "position": check.vector(shape.position, 3, "position"),
        "quat_xyzw": check.unit(shape.quat_xyzw, 4, "quat_xyzw")[0],
    }


def _packed(rotation: Array, position: Array, *dims: float) -> Array:
    packed = np.zeros(PACKED)
    packed[:9] = rotation.ravel(order="F")
    packed[9:12] = position
    packed[12 : 12 + len(dims)] = dims
    return packed


@dataclass(frozen=True, eq=False)
class _Named:
    """What all shapes have: a kind, a name, and a way into the problem file."""

    kind: ClassVar[str]
    name: str

    def to_dict(self) -> dict[str, Any]:
        """The obstacle as the problem file writes it."""
        keys = [entry.name for entry in fields(self) if entry.name != "name"]
        values = {key: np.asarray(getattr(self, key)).tolist() for key in keys}
        return {"name": self.name, "type": self.kind, **values}


@dataclass(frozen=True, eq=False)
class Box(_Named):
    """A box.

    Attributes:
        name: shown in reports and witnesses.
        size: full edge lengths, (3,), m.
        position: centre, (3,), m.
        quat_xyzw: orientation, (4,).

    Raises:
        ProblemError: a number is not finite, an edge is not positive, or the
            quaternion is not of unit length.
    """

    kind: ClassVar[str] = "box"
    size: Array
    position: Array = field(default_factory=_origin)
    quat_xyzw: Array = field(default_factory=_upright)

    def __post_init__(self) -> None:
        _checked(self, size=check.sizes(self.size, 3, "size"), **_pose(self))

    @property
    def rotation(self) -> Array:
        """Axes as columns, (3, 3)."""
        return matrix_from_quaternion(self.quat_xyzw)

    def pack(self) -> Array:
        """Rotation (9), position (3), m, and half edges (3), m: (16,)."""
        return _packed(self.rotation, self.position, *(0.5 * self.size))


@dataclass(frozen=True, eq=False)
class _Round(_Named):
    """What cylinders and capsules have: a radius, and a length along local z."""

    radius: float
    length: float
    position: Array = field(default_factory=_origin)
    quat_xyzw: Array = field(default_factory=_upright)

    def __post_init__(self) -> None:
        radius = check.positive(self.radius, "radius")
        length = check.positive(self.length, "length")
        _checked(self, radius=radius, length=length, **_pose(self))

    @property
    def rotation(self) -> Array:
        """Axes as columns, (3, 3)."""
        return matrix_from_quaternion(self.quat_xyzw)

    def pack(self) -> Array:
        """Rotation, position, radius and half length, (16,)."""
        return _packed(self.rotation, self.position, self.radius, 0.5 * self.length)


@dataclass(frozen=True, eq=False)
class Cylinder(_Round):
    """A cylinder around its local z axis.

    Attributes:
        name: shown in reports and witnesses.
        radius: m.
        length: between the flat ends, m.
        position: centre, (3,), m.
        quat_xyzw: orientation, (4,).

    Raises:
        ProblemError: as for a box.
    """

    kind: ClassVar[str] = "cylinder"


@dataclass(frozen=True, eq=False)
class Capsule(_Round):
    """All points within ``radius`` of a segment along the local z axis.

    Attributes:
        name: shown in reports and witnesses.
        radius: m.
        length: between the sphere centres, m.
        position: centre of the segment, (3,), m.
        quat_xyzw: orientation, (4,).

    Raises:
        ProblemError: as for a box.
    """

    kind: ClassVar[str] = "capsule"


@dataclass(frozen=True, eq=False)
class Sphere(_Named):
    """A ball.

    Attributes:
        name: shown in reports and witnesses.
        radius: m.
        position: centre, (3,), m.

    Raises:
        ProblemError: a number is not finite or the radius not positive.
    """

    kind: ClassVar[str] = "sphere"
    radius: float
    position: Array = field(default_factory=_origin)

    def __post_init__(self) -> None:
        _checked(
            self,
            name=check.text(self.name, "name"),
            radius=check.positive(self.radius, "radius"),
            position=check.vector(self.position, 3, "position"),
        )

    @property
    def rotation(self) -> Array:
        """Axes as columns, (3, 3): the identity."""
        return np.eye(3)

    def pack(self) -> Array:
        """Rotation (9), position (3), m, and radius, m: (16,)."""
        return _packed(self.rotation, self.position, self.radius)


@dataclass(frozen=True, eq=False)
class HalfSpace(_Named):
    """The solid ``{x : normal.x <= offset}``.

    A normal that is nearly of unit length is normalised together with the
    offset, so the solid stays the one that was written.

    Attributes:
        name: shown in reports and witnesses.
        normal: outward unit normal, (3,).
        offset: m.

    Raises:
        ProblemError: a number is not finite or the normal not of unit length.
    """

    kind: ClassVar[str] = "halfspace"
    normal: Array
    offset: float

    def __post_init__(self) -> None:
        normal, length = check.unit(self.normal, 3, "normal")
        offset = check.number(self.offset, "offset") / length
        name = check.text(self.name, "name")
        _checked(self, name=name, normal=normal, offset=offset)

    @property
    def rotation(self) -> Array:
        """Axes of a frame as columns, the third being the normal, (3, 3)."""
        return frame_around(self.normal)

    @property
    def position(self) -> Array:
        """The origin, (3,), m: the offset alone places the plane."""
        return np.zeros(3)

    def pack(self) -> Array:
        """Rotation (9), zeros (3) and offset, m: (16,)."""
        return _packed(self.rotation, self.position, self.offset)


Obstacle = Box | Cylinder | Capsule | Sphere | HalfSpace
