"""All that must keep apart, with what rounding may do to each pair."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rrnn_opt.check.arithmetic.doubles import GROW
from rrnn_opt.check.plans import hermite
from rrnn_opt.check.plans.collision.against import ObstacleTarget
from rrnn_opt.check.plans.collision.boxes import joint_pieces
from rrnn_opt.check.plans.collision.itself import SelfTarget
from rrnn_opt.check.plans.collision.movers import Movers, make_movers
from rrnn_opt.check.plans.collision.parts import Parts, Selection
from rrnn_opt.check.plans.collision.rounding import (
    Rounding,
    rounding,
    solid_slack,
)
from rrnn_opt.check.plans.collision.targets import Finer, Target
from rrnn_opt.check.plans.hermite import Pieces
from rrnn_opt.check.plans.motion import Motion
from rrnn_opt.check.plans.reading import Array
from rrnn_opt.check.plans.robot.model import Model
from rrnn_opt.check.plans.robot.motion_bound import reach_table
from rrnn_opt.check.plans.solids.distance import Solids
from rrnn_opt.check.plans.solids.obstacle import Obstacle


@dataclass(frozen=True, eq=False)
class Scene:
    """What a motion is judged by.

    Attributes:
        model: the robot, its bodies' balls among the spheres.
        joint: the motion as cubics of joint values, over each piece's own time.
        targets: what must keep apart, coarse ones.
        errors: rounding of the robot's own numbers.
    """

    model: Model
    joint: Pieces
    targets: list[Target]
    errors: Rounding

    @property
    def rounding_bound(self) -> float:
        """Largest slack of a target, m; 0 without one."""
        every = [0.0]
        for target in self.targets:
            level: Target | None = target
            while level is not None:
                every.append(float(level.slack.max()))
                level = None if level.finer is None else level.finer.target
        return max(every)


def build_scene(
    parts: Parts, obstacles: Sequence[Obstacle], margin: float, motion: Motion
) -> Scene:
    """Pairs of all moving spheres with the obstacles, and of one another.

    Args:
        parts: of the robot.
        obstacles: convex solids, and clouds.
        margin: least distance to an obstacle, m.
        motion: the rows.
    """
    model = parts.bodies.model
    joint = joint_pieces(model, motion.unit)
    errors = rounding(model, motion.t, motion.q, motion.qd)
    reach = reach_table(model, *_extents(joint, errors))
    levels = (*parts.singles, *parts.pairs)
    groups = [side for level in levels for side in level.sides]
    movers = make_movers(model, groups, reach, errors)
    chains = float((errors.chains + model.radii).max(initial=0.0))
    singles = len(parts.singles)
    targets = [
        _against(model, parts, movers[:singles], members, solids, margin, chains)
        for members, solids in _alike(obstacles)
    ]
    itself = _itself(model, parts, movers[singles:], chains)
    return Scene(model, joint, [*targets, itself], errors)


def _extents(p: Pieces, errors: Rounding) -> tuple[Array, Array]:
    """Least and greatest joint values that can occur, (nj,) each.

    A cubic lies between the least and greatest of its Bezier points
    q0, q0 + v0 / 3, q1 - v1 / 3, q1.
    """
    last = p.c1 + 2 * p.c2 + 3 * p.c3
    end = hermite.position(p, np.array(1.0))
    points = np.stack([p.c0, p.c0 + p.c1 / 3, end - last / 3, end])
    room = 8 * errors.values
    return points.min(axis=(0, 2)) - room, points.max(axis=(0, 2)) + room


def _alike(obstacles: Sequence[Obstacle]) -> list[tuple[tuple[int, ...], Solids]]:
    """Obstacles kind by kind, with their places; a mesh or a cloud stands alone."""
    groups: dict[tuple[str, int], list[int]] = {}
    for k, obstacle in enumerate(obstacles):
        alone = -1 if obstacle.matter is None else k
        groups.setdefault((obstacle.kind, alone), []).append(k)
    return [
        (tuple(places), Solids.of([obstacles[k] for k in places]))
        for places in groups.values()
    ]


def _against(
    model: Model,
    parts: Parts,
    movers: Sequence[Movers],
    members: tuple[int, ...],
    solids: Solids,
    margin: float,
    chains: float,
) -> Target:
    """Spheres against obstacles of one kind, body by body first."""
    room = solid_slack(chains + margin + solids.sizes)
    target: ObstacleTarget | None = None
    for chosen, side in zip(parts.singles, movers, strict=True):
        finer = _finer(target, chosen, len(members))
        slack = side.room + room
        target = ObstacleTarget(model, solids, members, side, margin, slack, finer)
    assert target is not None  # there is a level at least
    return target


def _itself(
    model: Model, parts: Parts, movers: Sequence[Movers], chains: float
) -> Target:
    """Self pairs: bodies, then cells, then spheres."""
    target: SelfTarget | None = None
    for k, chosen in enumerate(parts.pairs):
        first, second = movers[2 * k : 2 * k + 2]
        room = (first.room + second.room) * GROW + solid_slack(2 * chains)
        finer = _finer(target, chosen, 1)
        target = SelfTarget(model, (first, second), room.reshape(1), finer)
    assert target is not None  # there is a level at least
    return target


def _finer(target: Target | None, chosen: Selection, solids: int) -> Finer | None:
    if target is None or chosen.finer is None:
        return None
    width = len(chosen.spheres)
    return Finer(target, *chosen.finer, width, target.count // solids)
