"""The robot of a plan as plain arrays, and what follows from them alone."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.check.plans.reading import Array


@dataclass(frozen=True, eq=False)
class Model:
    """A robot of nj joints, nv coordinates and ns spheres.

    A rotation of the document stands for the exact rotation nearest to it, an
    axis for its direction; what is kept here is within 24 u and 4 u of them.

    Attributes:
        parents: parent joint, -1 for the base, (nj,).
        rotation: of each joint frame in its parent's at value zero, (nj, 3, 3).
        translation: (nj, 3), m.
        axes: unit axes in the joint frames, (nj, 3).
        prismatic: (nj,) bool.
        continuous: coordinates that turn without end, (nv,) bool.
        source: coordinate of each joint, (nj,).
        multiplier: (nj,).
        offset: (nj,).
        moved_by: ``[i, k]``: joint k moves the frame of joint i, (nj, nj) bool.
        lower: (nv,), -inf where there is none.
        upper: (nv,), +inf where there is none.
        velocity: (nv,).
        acceleration: (nv,).
        links: body of each sphere, ns of them.
        carrier: joint of each sphere, -1 for the base, (ns,).
        centres: in the joint frame, (ns, 3), m.
        radii: (ns,), m.
        pairs: sphere index pairs of the self pairs, (np, 2).
        tip: (name, joint, rotation, translation) of the end effector.
    """

    parents: NDArray[np.int64]
    rotation: Array
    translation: Array
    axes: Array
    prismatic: NDArray[np.bool_]
    continuous: NDArray[np.bool_]
    source: NDArray[np.int64]
    multiplier: Array
    offset: Array
    moved_by: NDArray[np.bool_]
    lower: Array
    upper: Array
    velocity: Array
    acceleration: Array
    links: tuple[str, ...]
    carrier: NDArray[np.int64]
    centres: Array
    radii: Array
    pairs: NDArray[np.int64]
    tip: tuple[str, int, Array, Array]

    @property
    def nj(self) -> int:
        """Number of joints."""
        return len(self.parents)

    @property
    def nv(self) -> int:
        """Number of coordinates."""
        return len(self.velocity)

    def joint_values(self, q: Array) -> Array:
        """Coordinates (N, nv) to joint values (N, nj)."""
        return self.multiplier * q[:, self.source] + self.offset

    @cached_property
    def sphere_moved_by(self) -> NDArray[np.bool_]:
        """``[i, k]``: joint k moves sphere i, (ns, nj)."""
        padded = np.vstack([self.moved_by, np.zeros((1, self.nj), dtype=bool)])
        return padded[self.carrier]  # carrier -1 takes the last row: nothing

    @cached_property
    def slides(self) -> Array:
        """Axes in their parents' frames, (nj, 3)."""
        slides: Array = np.einsum("kij,kj->ki", self.rotation, self.axes)
        return slides

    @cached_property
    def turn_forms(self) -> Array:
        """The three matrices whose sum is a joint's frame in its parent's.

        ``P (a a' + cos (I - a a') + sin [a]x)``, P the placement and a the axis;
        a slide does not turn, its first matrix is P and the others are zero.

        Returns:
            (nj, 3, 3, 3).
        """
        p, (x, y, z) = self.rotation, self.axes.T
        zero = np.zeros_like(x)
        cross = np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]])
        along = self.slides[:, :, None] * self.axes[:, None, :]
        forms = np.stack([along, p - along, p @ np.moveaxis(cross, 2, 0)], axis=1)
        forms[self.prismatic] = 0.0
        forms[self.prismatic, 0] = p[self.prismatic]
        return forms

    @cached_property
    def carried(self) -> tuple[tuple[int, NDArray[np.int64]], ...]:
        """Joints that carry spheres (-1: the base), and the spheres of each."""
        joints = np.unique(self.carrier).tolist()
        return tuple((k, np.flatnonzero(self.carrier == k)) for k in joints)
