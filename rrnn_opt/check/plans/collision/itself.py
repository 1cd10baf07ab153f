"""Spheres of the robot against one another."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rrnn_opt.check.plans.collision.boxes import Index, Poses
from rrnn_opt.check.plans.collision.movers import Movers, first_order, way
from rrnn_opt.check.plans.collision.targets import Finer, FirstLook
from rrnn_opt.check.plans.reading import Array
from rrnn_opt.check.plans.robot.model import Model
from rrnn_opt.check.plans.solids.distance import TINY


@dataclass(frozen=True, eq=False)
class SelfTarget:
    """Spheres of the robot against one another.

    Motion is taken relative to the last joint that moves both, so only the
    joints that move exactly one of the two count.

    Attributes:
        model: the robot.
        sides: first and second spheres of the pairs.
        slack: the same for all, (1,), m.
        finer: see :class:`Target`.
        required: m.
    """

    model: Model
    sides: tuple[Movers, Movers]
    slack: Array
    finer: Finer | None = None
    required: float = 0.0

    @property
    def count(self) -> int:
        """Number of pairs."""
        return len(self.sides[0].spheres)

    @property
    def spheres(self) -> tuple[Index, ...]:
        """See :class:`Target`."""
        return tuple(side.spheres for side in self.sides)

    def room(self, pair: Index) -> Array:
        """See :class:`Target`."""
        return self.slack

    @cached_property
    def _levers(self) -> Array:
        return self.sides[0].levers + self.sides[1].levers

    @cached_property
    def _radii(self) -> Array:
        i, j = self.spheres
        return self.model.radii[i] + self.model.radii[j]

    def first(self, poses: Poses) -> FirstLook:
        """See :class:`Target`."""
        i, j = self.spheres
        apart = poses.centres[:, i] - poses.centres[:, j]
        d = np.sqrt((apart * apart).sum(axis=0)) - self._radii[:, None]
        return FirstLook(d[None], (d - self._levers.T @ poses.sway)[None])

    def travel(self, poses: Poses, box: Index, pair: Index) -> Array:
        """See :class:`Target`."""
        return way(poses, self._levers, box, pair)

    def distance(self, poses: Poses, box: Index, pair: Index) -> Array:
        """See :class:`Target`."""
        i, j = (poses.points(box, side[pair]) for side in self.spheres)
        apart = i - j
        far: Array = np.sqrt((apart * apart).sum(axis=0))
        return far - self._radii[pair]

    def floor(self, poses: Poses, box: Index, pair: Index, d: Array) -> Array:
        """See :class:`Target`."""
        return d

    def sharp(self, poses: Poses, box: Index, pair: Index) -> Array:
        """See :class:`Target`."""
        first, second = self.sides
        at_i, at_j = (poses.points(box, side[pair]) for side in self.spheres)
        apart = at_i - at_j
        far = np.sqrt((apart * apart).sum(axis=0))
        usual = far > TINY
        n = np.where(usual, apart / np.where(usual, far, 1.0), [[1.0], [0.0], [0.0]])
        free = (n * apart).sum(axis=0) - self._radii[pair]
        row_i, rest_i = first.bend(poses, box, pair, at_i, n)
        row_j, rest_j = second.bend(poses, box, pair, at_j, n)
        bend = first_order(poses, box, row_i - row_j)
        bound: Array = free - bend - (rest_i + rest_j) / 2
        return bound

    def label(self, pair: int) -> list[str]:
        """See :class:`Target`."""
        return [self.model.links[side[pair]] for side in self.spheres]
