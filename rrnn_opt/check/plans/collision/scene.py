"""All that must keep apart, with what rounding may do to each pair."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rrnn_opt.check.arithmetic.doubles import GROW
from rrnn_opt.check.plans import hermite
from rrnn_opt.check.plans.collision.boxes import joint_pieces
from rrnn_opt.check.plans.collision.movers import Movers
from rrnn_opt.check.plans.collision.parts import Parts, Selection
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
    parts: Parts, obstacles: Sequence[Obstacle], margin: float, motion: Motion
) -> Scene:
    """Pairs of all moving spheres with the obstacles, and of one another.

    Args:
        parts: of the robot.
        obstacles: convex solids.
        margin: least distance to an obstacle, m.
        motion: the rows.
    """
    model = parts.bodies.model
    errors = rounding(model, motion.t, motion.q, motion.qd)
    reach = reach_table(model, *_extents(model, motion, errors))
    make = _Maker(model, reach, errors)
    targets = [*make.against(parts, obstacles, margin), make.itself(parts)]
    return Scene(model, targets, errors)


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


@dataclass(frozen=True, eq=False)
class _Maker:
    """Makes the targets of one motion: coarse ones that know their finer ones."""

    model: Model
    reach: Array
    errors: Rounding

    def against(
        self, parts: Parts, obstacles: Sequence[Obstacle], margin: float
    ) -> list[Target]:
        """Spheres against obstacles, body by body first."""
        model, sides = self.model, [self._movers(s)[0] for s in parts.singles]
        far = float((self.errors.chains + model.radii).max(initial=0.0)) + margin
        targets: list[Target] = []
        for obstacle in obstacles:
            solid = solid_slack(far + obstacle.size)
            target: ObstacleTarget | None = None
            for chosen, movers in zip(parts.singles, sides, strict=True):
                finer, room = _finer(target, chosen), movers.room + solid
                target = ObstacleTarget(model, obstacle, movers, margin, room, finer)
            targets += [] if target is None else [target]
        return targets

    def _movers(self, chosen: Selection) -> tuple[Movers, ...]:
        sides = zip(chosen.spheres.T, chosen.moved, strict=True)
        return tuple(
            Movers.of(self.model, spheres, moved, self.reach, self.errors)
            for spheres, moved in sides
        )

    def itself(self, parts: Parts) -> Target:
        """Self pairs: bodies, then cells, then spheres."""
        far = 2 * float((self.errors.chains + self.model.radii).max(initial=0.0))
        target: SelfTarget | None = None
        for chosen in parts.pairs:
            first, second = self._movers(chosen)
            room = (first.room + second.room) * GROW + solid_slack(far)
            finer = _finer(target, chosen)
            target = SelfTarget(self.model, (first, second), room, finer)
        assert target is not None  # there is a level at least
        return target


def _finer(target: Target | None, chosen: Selection) -> Finer | None:
    if target is None or chosen.finer is None:
        return None
    return Finer(target, *chosen.finer)
