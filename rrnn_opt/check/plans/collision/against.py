"""Spheres against obstacles of one kind."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rrnn_opt.check.plans.collision.boxes import Index, Poses
from rrnn_opt.check.plans.collision.movers import Movers, first_order, way
from rrnn_opt.check.plans.collision.targets import Finer, FirstLook
from rrnn_opt.check.plans.reading import Array
from rrnn_opt.check.plans.robot.model import Model
from rrnn_opt.check.plans.solids.distance import Solids


@dataclass(frozen=True, eq=False)
class ObstacleTarget:
    """Spheres that can move, against obstacles of one kind.

    Attributes:
        model: the robot.
        solids: the obstacles.
        members: their places in the problem's list.
        movers: the spheres; a pair is one of them with one obstacle.
        required: the margin, m.
        slack: one an obstacle, m.
        finer: see :class:`Target`.
    """

    model: Model
    solids: Solids
    members: tuple[int, ...]
    movers: Movers
    required: float
    slack: Array
    finer: Finer | None = None

    @property
    def count(self) -> int:
        """Number of spheres times number of obstacles."""
        return len(self.movers.spheres) * len(self.members)

    @cached_property
    def _own(self) -> Index:
        """Which of the movers each pair is."""
        return np.tile(np.arange(len(self.movers.spheres)), len(self.members))

    @cached_property
    def _solid(self) -> Index:
        return np.repeat(np.arange(len(self.members)), len(self.movers.spheres))

    @cached_property
    def spheres(self) -> tuple[Index, ...]:
        """See :class:`Target`."""
        return (self.movers.spheres[self._own],)

    def room(self, pair: Index) -> Array:
        """See :class:`Target`."""
        return np.asarray(self.slack[self._solid[pair]])

    def first(self, poses: Poses) -> FirstLook:
        """See :class:`Target`; a mesh's cheap bound rests on ``floor``."""
        spheres, count = self.movers.spheres, poses.sway.shape[1]
        shape = len(self.members), len(spheres), count
        points = poses.centres[:, spheres].reshape(3, -1)
        d = self.solids.every_distance(points).reshape(shape)
        d = d - self.model.radii[spheres][:, None]
        floor = d
        if self.solids.kind == "mesh":
            pair = np.repeat(np.arange(self.count), count)
            box = np.tile(np.arange(count), self.count)
            floor = self.floor(poses, box, pair, d.ravel()).reshape(shape)
        return FirstLook(d, floor - self.movers.levers.T @ poses.sway)

    def travel(self, poses: Poses, box: Index, pair: Index) -> Array:
        """See :class:`Target`."""
        return way(poses, self.movers.levers, box, self._own[pair])

    def distance(self, poses: Poses, box: Index, pair: Index) -> Array:
        """See :class:`Target`."""
        sphere = self.spheres[0][pair]
        d = self.solids.distance(poses.points(box, sphere), self._solid[pair])
        return d - self.model.radii[sphere]

    def floor(self, poses: Poses, box: Index, pair: Index, d: Array) -> Array:
        """See :class:`Target`; triangles of a mesh refute, its points prove."""
        if self.solids.kind != "mesh":
            return d
        sphere = self.spheres[0][pair]
        free, _ = self.solids.facing(poses.points(box, sphere), self._solid[pair])
        return np.minimum(d, free - self.model.radii[sphere])

    def sharp(self, poses: Poses, box: Index, pair: Index) -> Array:
        """See :class:`Target`."""
        sphere, own = self.spheres[0][pair], self._own[pair]
        points = poses.points(box, sphere)
        free, n = self.solids.facing(points, self._solid[pair])
        row, rest = self.movers.bend(poses, box, own, points, n)
        free = free - self.model.radii[sphere]
        bound: Array = free - first_order(poses, box, row) - rest / 2
        return bound

    def label(self, pair: int) -> list[str]:
        """See :class:`Target`."""
        link = self.model.links[self.spheres[0][pair]]
        return [link, self.solids.names[self._solid[pair]]]
