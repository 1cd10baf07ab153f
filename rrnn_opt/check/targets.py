"""What must stay apart: spheres from an obstacle, spheres from one another.

Each target numbers its pairs 0, 1, .. and answers, for rows (box, pair):
the distance at the box's middle, a cheap bound over the box (distance minus
travel), and a sharp one,

    gap - |n'J v tau| - |n'J a tau^2 / 2| - |n'J j tau^3 / 6| - B(h) / 2,

the terms being those of the joints' exact cubics.  A convex obstacle lies in
a half-space with normal n, so the sharp bound holds for the whole box.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.check.boxes import Index, Poses
from rrnn_opt.check.distance import Obstacle, gap, normals, signed_distance
from rrnn_opt.check.model import Model
from rrnn_opt.check.motion_bound import motion_bound, travel_levers
from rrnn_opt.check.reading import Array


class Target(Protocol):
    """Pairs that must keep at least ``required`` metres apart."""

    @property
    def required(self) -> float:
        """Least distance, m."""

    @property
    def count(self) -> int:
        """Number of pairs."""

    def travel(self, poses: Poses) -> Array:
        """How far each pair can approach inside each box, (B, count), m."""

    def distance(self, poses: Poses, box: Index, pair: Index) -> Array:
        """Signed distance at the middle, (M,), m."""

    def sharp(self, poses: Poses, box: Index, pair: Index) -> Array:
        """Lower bound of the distance over the whole box, (M,), m."""

    def label(self, pair: int) -> list[str]:
        """The two names of a pair."""


def _row_jacobian(
    poses: Poses, prismatic: NDArray[np.bool_], box: Index, points: Array, n: Array
) -> Array:
    """Rows n'J of points at the joints (unmasked), (M, nj)."""
    axes, origins = poses.axes[box], poses.origins[box]
    across = np.cross(axes, points[:, None] - origins)
    columns = np.where(prismatic[:, None], axes, across)
    row: Array = np.einsum("mki,mi->mk", columns, n)
    return row


def _first_order(poses: Poses, box: Index, row: Array) -> Array:
    """Largest |n'J delta| inside the box, from the cubic's own terms."""
    along: Array = np.einsum("mk,cmk->cm", row, poses.terms[:, box])
    most: Array = np.abs(along).sum(axis=0)
    return most


@dataclass(frozen=True, eq=False)
class ObstacleTarget:
    """Spheres that can move, against one obstacle.

    Attributes:
        model: the robot.
        obstacle: the solid.
        spheres: index of each pair's sphere, (count,).
        reach: reach table, (ns, nj), m.
        required: the margin, m.
    """

    model: Model
    obstacle: Obstacle
    spheres: Index
    reach: Array
    required: float

    @property
    def count(self) -> int:
        """Number of spheres."""
        return len(self.spheres)

    def travel(self, poses: Poses) -> Array:
        """See :class:`Target`."""
        moved = self.model.sphere_moved_by()[self.spheres]
        reach = self.reach[self.spheres]
        levers = travel_levers(reach, moved, self.model.prismatic)
        return np.asarray(poses.sway @ levers.T, dtype=np.float64)

    def distance(self, poses: Poses, box: Index, pair: Index) -> Array:
        """See :class:`Target`."""
        sphere = self.spheres[pair]
        d = signed_distance(self.obstacle, poses.centres[box, sphere])
        return d - self.model.radii[sphere]

    def sharp(self, poses: Poses, box: Index, pair: Index) -> Array:
        """See :class:`Target`."""
        sphere = self.spheres[pair]
        points = poses.centres[box, sphere]
        n = normals(self.obstacle, points)
        moved = self.model.sphere_moved_by()[sphere]
        prismatic = self.model.prismatic
        row = _row_jacobian(poses, prismatic, box, points, n) * moved
        rest = motion_bound(poses.sway[box], self.reach[sphere], moved, prismatic)
        free = gap(self.obstacle, points, n) - self.model.radii[sphere]
        bound: Array = free - _first_order(poses, box, row) - rest / 2
        return bound

    def label(self, pair: int) -> list[str]:
        """See :class:`Target`."""
        return [self.model.links[self.spheres[pair]], self.obstacle.name]


@dataclass(frozen=True, eq=False)
class SelfTarget:
    """Spheres of the robot against one another.

    Motion is taken relative to the last joint that moves both, so only the
    joints that move exactly one of the two count.

    Attributes:
        model: the robot.
        pairs: sphere indices, (count, 2).
        reach: reach table, (ns, nj), m.
        required: m.
    """

    model: Model
    pairs: Index
    reach: Array
    required: float = 0.0

    @property
    def count(self) -> int:
        """Number of pairs."""
        return len(self.pairs)

    def _own(self, pairs: Index) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        moved = self.model.sphere_moved_by()
        first, second = moved[pairs[:, 0]], moved[pairs[:, 1]]
        return first & ~second, second & ~first

    def travel(self, poses: Poses) -> Array:
        """See :class:`Target`."""
        levers = np.zeros((self.count, self.model.nj))
        for k, own in enumerate(self._own(self.pairs)):
            reach = self.reach[self.pairs[:, k]]
            levers += travel_levers(reach, own, self.model.prismatic)
        return np.asarray(poses.sway @ levers.T, dtype=np.float64)

    def distance(self, poses: Poses, box: Index, pair: Index) -> Array:
        """See :class:`Target`."""
        i, j = self.pairs[pair, 0], self.pairs[pair, 1]
        apart = poses.centres[box, i] - poses.centres[box, j]
        far: Array = np.sqrt(np.einsum("ij,ij->i", apart, apart))
        return np.asarray(far - self.model.radii[i] - self.model.radii[j])

    def sharp(self, poses: Poses, box: Index, pair: Index) -> Array:
        """See :class:`Target`."""
        sides = self.pairs[pair]
        apart = poses.centres[box, sides[:, 0]] - poses.centres[box, sides[:, 1]]
        far = np.linalg.norm(apart, axis=1)[:, None]
        n = np.where(far > 0, apart / np.where(far > 0, far, 1.0), (1.0, 0.0, 0.0))
        free = np.einsum("ij,ij->i", n, apart) - self.model.radii[sides].sum(axis=1)
        prismatic, sway = self.model.prismatic, poses.sway[box]
        row, rest = np.zeros_like(sway), np.zeros(len(box))
        for k, own in enumerate(self._own(sides)):
            sphere, sign = sides[:, k], 1 - 2 * k
            points = poses.centres[box, sphere]
            row += sign * own * _row_jacobian(poses, prismatic, box, points, n)
            rest += motion_bound(sway, self.reach[sphere], own, prismatic)
        bound: Array = free - _first_order(poses, box, row) - rest / 2
        return bound

    def label(self, pair: int) -> list[str]:
        """See :class:`Target`."""
        return [self.model.links[k] for k in self.pairs[pair]]
