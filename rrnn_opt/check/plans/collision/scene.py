"""All that must keep apart, with what rounding may do to each pair."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rrnn_opt.check.arithmetic.doubles import GROW
from rrnn_opt.check.plans import hermite
from rrnn_opt.check.plans.collision.bodies import Bodies, Index, with_balls
from rrnn_opt.check.plans.collision.boxes import joint_pieces
from rrnn_opt.check.plans.collision.movers import Movers
from rrnn_opt.check.plans.collision.rounding import (
    Rounding,
    rounding,
    solid_slack,
)
from rrnn_opt.check.plans.collision.targets import (
    Finer,
    ObstacleTarget,
    SelfTarget,
    Target,
)
from rrnn_opt.check.plans.motion import Motion
from rrnn_opt.check.plans.reading import Array
from rrnn_opt.check.plans.robot.model import Model
from rrnn_opt.check.plans.robot.motion_bound import reach_table
from rrnn_opt.check.plans.solids.distance import Obstacle


@dataclass(frozen=True, eq=False)
class Scene:
    """What a motion is judged by.

    Attributes:
        model: the robot, its bodies' balls among the spheres.
        targets: what must keep apart, coarse ones.
        errors: rounding of the robot's own numbers.
    """

    model: Model
    targets: list[Target]
    errors: Rounding

    @property
    def rounding_bound(self) -> float:
        """Largest slack of a target, m; 0 without one."""
        every = [0.0]
        for target in self.targets:
            level: Target | None = target
            while level is not None:
                every.append(level.slack)
                level = None if level.finer is None else level.finer.target
        return max(every)


def build_scene(
    model: Model, obstacles: Sequence[Obstacle], margin: float, motion: Motion
) -> Scene:
    """Pairs of all moving spheres with the obstacles, and of one another.

    Args:
        model: the robot.
        obstacles: convex solids.
        margin: least distance to an obstacle, m.
        motion: the rows.
    """
    bodies = with_balls(model)
    errors = rounding(bodies.model, motion.t, motion.q, motion.qd)
    reach = reach_table(bodies.model, *_extents(model, motion, errors))
    make = _Maker(bodies, reach, errors)
    targets = [*make.against(obstacles, margin), make.itself()]
    return Scene(bodies.model, targets, errors)


def _extents(model: Model, motion: Motion, errors: Rounding) -> tuple[Array, Array]:
    """Least and greatest joint values that can occur, (nj,) each.

    A cubic lies between the least and greatest of its Bezier points
    q0, q0 + v0 / 3, q1 - v1 / 3, q1.
    """
    p = joint_pieces(model, motion.unit)
    last = p.c1 + 2 * p.c2 + 3 * p.c3
    end = hermite.position(p, np.array(1.0))
    points = np.stack([p.c0, p.c0 + p.c1 / 3, end - last / 3, end])
    room = 8 * errors.values
    return points.min(axis=(0, 1)) - room, points.max(axis=(0, 1)) + room


def _grouped(rows: Index) -> tuple[Index, Index, Index]:
    """Different rows, and the rows' numbers group by group with group sizes."""
    keys, group, sizes = np.unique(
        rows, axis=0, return_inverse=True, return_counts=True
    )
    return keys, np.argsort(group.ravel(), kind="stable"), sizes


@dataclass(frozen=True, eq=False)
class _Maker:
    """Makes the targets of one robot: coarse ones that know their finer ones."""

    bodies: Bodies
    reach: Array
    errors: Rounding

    def against(self, obstacles: Sequence[Obstacle], margin: float) -> list[Target]:
        """Spheres against obstacles, body by body first."""
        model, ns = self.bodies.model, self.bodies.ns
        spheres = np.arange(ns)[model.carrier[:ns] >= 0]
        keys, order, sizes = _grouped(self.bodies.body[spheres])
        fine, balls = self._movers(spheres), self._movers(keys)
        far = float((self.errors.chains + model.radii).max(initial=0.0)) + margin
        targets: list[Target] = []
        for obstacle in obstacles:
            solid = solid_slack(far + obstacle.size)
            inner = ObstacleTarget(model, obstacle, fine, margin, fine.room + solid)
            finer, room = Finer(inner, order, sizes), balls.room + solid
            targets.append(ObstacleTarget(model, obstacle, balls, margin, room, finer))
        return targets

    def _movers(self, spheres: Index) -> Movers:
        moved = self.bodies.model.sphere_moved_by[spheres]
        return Movers.of(self.bodies.model, spheres, moved, self.reach, self.errors)

    def itself(self) -> Target:
        """Self pairs: bodies, then cells, then spheres."""
        model = self.bodies.model
        # two bodies that cannot move are nobody's concern
        pairs = model.pairs[np.any(model.carrier[model.pairs] >= 0, axis=1)]
        target = self._among(pairs)
        for up in (self.bodies.cell, self.bodies.body):
            pairs, order, sizes = _grouped(up[pairs])
            target = self._among(pairs, Finer(target, order, sizes))
        return target

    def _among(self, pairs: Index, finer: Finer | None = None) -> SelfTarget:
        model, errors = self.bodies.model, self.errors
        i, j = pairs.T
        moved = model.sphere_moved_by
        sides = (
            Movers.of(model, i, moved[i] & ~moved[j], self.reach, errors),
            Movers.of(model, j, moved[j] & ~moved[i], self.reach, errors),
        )
        far = 2 * float((errors.chains + model.radii).max(initial=0.0))
        room = (sides[0].room + sides[1].room) * GROW + solid_slack(far)
        return SelfTarget(model, sides, room, finer)
