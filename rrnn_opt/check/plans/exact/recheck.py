"""A proof by doubles, proved again in ball arithmetic.

The double version says which time boxes it proved for which pairs.  Here those
boxes are shown to cover every piece without a hole, and each row's bound is
evaluated anew in balls (:mod:`~rrnn_opt.check.plans.exact.robot`), with no slack and
nothing taken from the doubles but the proposed normals, of which any will do.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import flint

from rrnn_opt.check.plans.collision.targets import Target
from rrnn_opt.check.plans.collision.worklist import Leaf
from rrnn_opt.check.plans.exact.cover import covered, nested
from rrnn_opt.check.plans.exact.robot import (
    PRECISION,
    exact,
    length,
)
from rrnn_opt.check.plans.exact.scene import BallScene, Moment

DEEPEST = 8


@dataclass(frozen=True)
class Recheck:
    """What ball arithmetic says of a proof.

    Attributes:
        rows: (box, pair) rows that were evaluated.
        failed: those that it could not confirm.
        covered: the boxes cover all times of all pairs, without a hole, and
            balls around bodies hold their spheres.
    """

    rows: int
    failed: int
    covered: bool

    @property
    def proved(self) -> bool:
        """Nothing failed, and nothing was left out."""
        return self.covered and self.failed == 0


def recheck(scene: BallScene, leaves: Sequence[Leaf], *, every: int = 1) -> Recheck:
    """Prove again what the doubles proved.

    Args:
        scene: in balls.
        leaves: what was proved where.
        every: look at every n-th row only; 1 for a proof.
    """
    rows = failed = 0
    with flint.ctx.workprec(PRECISION):
        for (piece, middle, half), work in _by_box(leaves, every):
            now = scene.moment(piece, middle, half)
            for target, pair in work:
                rows += 1
                at = piece, middle, half
                failed += not _confirmed(scene, target, pair, at, now)
        held = balls_hold(scene)
    pieces = len(scene.motion.t) - 1
    whole = held and covered(scene.scene.targets, leaves, pieces)
    return Recheck(rows, failed, whole)


def balls_hold(scene: BallScene) -> bool:
    """Whether every ball of a coarse look holds the spheres that it stands for."""
    body, model = scene.body, scene.scene.model
    for ball, sphere in nested(scene.scene.targets):
        away = zip(body.centres[ball], body.centres[sphere], strict=True)
        need = length([a - b for a, b in away]) + body.radii[sphere]
        apart = ball != sphere and not need <= body.radii[ball]
        if apart or model.carrier[ball] != model.carrier[sphere]:
            return False
    return True


Box = tuple[int, float, float]


def _by_box(
    leaves: Sequence[Leaf], every: int
) -> Iterator[tuple[Box, list[tuple[Target, int]]]]:
    """The rows of each box together: its kinematics are needed but once."""
    table: dict[Box, list[tuple[Target, int]]] = {}
    count = 0
    for leaf in leaves:
        piece, middle = leaf.boxes.piece[leaf.box], leaf.boxes.middle[leaf.box]
        half = leaf.boxes.half[leaf.box]
        rows = zip(piece.tolist(), middle.tolist(), half.tolist(), strict=True)
        for box, pair in zip(rows, leaf.pair.tolist(), strict=True):
            if count % every == 0:
                table.setdefault(box, []).append((leaf.target, pair))
            count += 1
    yield from table.items()


def _confirmed(
    scene: BallScene, target: Target, pair: int, box: Box, now: Moment, depth: int = 0
) -> bool:
    """Whether balls prove a row, its box halved where that is needed."""
    if scene.bound(target, pair, now) > exact(target.required):
        return True
    if depth == DEEPEST:
        return False
    piece, middle, half = box
    parts = [(piece, middle + side * half / 2, half / 2) for side in (-1, 1)]
    return all(
        _confirmed(scene, target, pair, part, scene.moment(*part), depth + 1)
        for part in parts
    )
