"""What must stay apart: spheres from an obstacle, spheres from one another.

Each target numbers its pairs 0, 1, .. and answers, for rows (box, pair):
the distance at the box's middle, a cheap bound over the box (distance minus
travel), and a sharp one,

    gap - |n'J v tau| - |n'J a tau^2 / 2| - |n'J j tau^3 / 6| - B(h) / 2,

the terms being those of the joints' exact cubics.  A convex obstacle lies in
a half-space with normal n, so the sharp bound holds for the whole box.  A
coarse target speaks of balls that hold several spheres of one body; what it
cannot settle goes to the pairs of its ``finer`` one.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np

from rrnn_opt.check.plans.collision.boxes import Index, Poses
from rrnn_opt.check.plans.collision.movers import Movers, first_order, way
from rrnn_opt.check.plans.reading import Array
from rrnn_opt.check.plans.robot.model import Model
from rrnn_opt.check.plans.solids.distance import (
    TINY,
    Obstacle,
    gap,
    normals,
    signed_distance,
)


class Target(Protocol):
    """Pairs that must keep at least ``required`` metres apart."""

    @property
    def required(self) -> float:
        """Least distance, m."""

    @property
    def slack(self) -> float:
        """No bound or distance given here is off by more, m."""

    @property
    def count(self) -> int:
        """Number of pairs."""

    @property
    def finer(self) -> Finer | None:
        """Where the pairs are taken apart; None if they are single spheres."""

    def travel(self, poses: Poses, box: Index, pair: Index) -> Array:
        """How far the pair can approach inside the box, (M,), m."""

    def distance(self, poses: Poses, box: Index, pair: Index) -> Array:
        """Signed distance at the middle, (M,), m."""

    def floor(self, poses: Poses, box: Index, pair: Index, d: Array) -> Array:
        """Lower bound of the distance at the middle, d or less, (M,), m."""

    def sharp(self, poses: Poses, box: Index, pair: Index) -> Array:
        """Lower bound of the distance over the whole box, (M,), m."""

    def label(self, pair: int) -> list[str]:
        """The two names of a pair."""


@dataclass(frozen=True, eq=False)
class Finer:
    """The pairs that those of a coarse target stand for.

    Attributes:
        target: of single spheres.
        pairs: its pairs, in the order of the coarse ones, (sum of sizes,).
        sizes: how many each coarse pair has, (count,).
    """

    target: Target
    pairs: Index
    sizes: Index

    @cached_property
    def first(self) -> Index:
        """Where each coarse pair's own begin, (count,)."""
        return np.cumsum(self.sizes) - self.sizes

    def rows(self, box: Index, pair: Index) -> tuple[Index, Index]:
        """Rows (box, pair) of the finer target for rows of the coarse one."""
        sizes = self.sizes[pair]
        ends = np.cumsum(sizes)
        inner = np.arange(int(sizes.sum())) - np.repeat(ends - sizes, sizes)
        return (
            np.repeat(box, sizes),
            self.pairs[np.repeat(self.first[pair], sizes) + inner],
        )


@dataclass(frozen=True, eq=False)
class ObstacleTarget:
    """Spheres that can move, against one obstacle.

    Attributes:
        model: the robot.
        obstacle: the solid.
        movers: the spheres, one a pair.
        required: the margin, m.
        slack: m.
        finer: see :class:`Target`.
    """

    model: Model
    obstacle: Obstacle
    movers: Movers
    required: float
    slack: float
    finer: Finer | None = None

    @property
    def count(self) -> int:
        """Number of spheres."""
        return len(self.movers.spheres)

    def travel(self, poses: Poses, box: Index, pair: Index) -> Array:
        """See :class:`Target`."""
        return way(poses, self.movers.levers, box, pair)

    def distance(self, poses: Poses, box: Index, pair: Index) -> Array:
        """See :class:`Target`."""
        sphere = self.movers.spheres[pair]
        d = signed_distance(self.obstacle, poses.points(box, sphere))
        return d - self.model.radii[sphere]

    def floor(self, poses: Poses, box: Index, pair: Index, d: Array) -> Array:
        """See :class:`Target`; triangles of a mesh refute, its points prove."""
        if self.obstacle.kind != "mesh":
            return d
        sphere = self.movers.spheres[pair]
        points = poses.points(box, sphere)
        free = gap(self.obstacle, points, normals(self.obstacle, points))
        return np.minimum(d, free - self.model.radii[sphere])

    def sharp(self, poses: Poses, box: Index, pair: Index) -> Array:
        """See :class:`Target`."""
        sphere = self.movers.spheres[pair]
        points = poses.points(box, sphere)
        n = normals(self.obstacle, points)
        row, rest = self.movers.bend(poses, box, pair, points, n)
        free = gap(self.obstacle, points, n) - self.model.radii[sphere]
        bound: Array = free - first_order(poses, box, row) - rest / 2
        return bound

    def label(self, pair: int) -> list[str]:
        """See :class:`Target`."""
        return [self.model.links[self.movers.spheres[pair]], self.obstacle.name]


@dataclass(frozen=True, eq=False)
class SelfTarget:
    """Spheres of the robot against one another.

    Motion is taken relative to the last joint that moves both, so only the
    joints that move exactly one of the two count.

    Attributes:
        model: the robot.
        sides: first and second spheres of the pairs.
        slack: m.
        finer: see :class:`Target`.
        required: m.
    """

    model: Model
    sides: tuple[Movers, Movers]
    slack: float
    finer: Finer | None = None
    required: float = 0.0

    @property
    def count(self) -> int:
        """Number of pairs."""
        return len(self.sides[0].spheres)

    @cached_property
    def _levers(self) -> Array:
        return self.sides[0].levers + self.sides[1].levers

    def travel(self, poses: Poses, box: Index, pair: Index) -> Array:
        """See :class:`Target`."""
        return way(poses, self._levers, box, pair)

    def distance(self, poses: Poses, box: Index, pair: Index) -> Array:
        """See :class:`Target`."""
        i, j = (side.spheres[pair] for side in self.sides)
        apart = poses.points(box, i) - poses.points(box, j)
        far: Array = np.sqrt(np.einsum("ij,ij->i", apart, apart))
        return far - (self.model.radii[i] + self.model.radii[j])

    def floor(self, poses: Poses, box: Index, pair: Index, d: Array) -> Array:
        """See :class:`Target`."""
        return d

    def sharp(self, poses: Poses, box: Index, pair: Index) -> Array:
        """See :class:`Target`."""
        first, second = self.sides
        i, j = first.spheres[pair], second.spheres[pair]
        at_i, at_j = poses.points(box, i), poses.points(box, j)
        apart = at_i - at_j
        far = np.sqrt(np.einsum("ij,ij->i", apart, apart))[:, None]
        usual = far > TINY
        n = np.where(usual, apart / np.where(usual, far, 1.0), (1.0, 0.0, 0.0))
        free = np.einsum("ij,ij->i", n, apart)
        free -= self.model.radii[i] + self.model.radii[j]
        row_i, rest_i = first.bend(poses, box, pair, at_i, n)
        row_j, rest_j = second.bend(poses, box, pair, at_j, n)
        bend = first_order(poses, box, row_i - row_j)
        bound: Array = free - bend - (rest_i + rest_j) / 2
        return bound

    def label(self, pair: int) -> list[str]:
        """See :class:`Target`."""
        return [self.model.links[side.spheres[pair]] for side in self.sides]
