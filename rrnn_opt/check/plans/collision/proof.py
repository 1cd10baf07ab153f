"""Freedom from collision for all times, by subdivision in time.

Every (box, pair) is either proved by a bound over the whole box, refuted by
the box's middle, or handed to both halves of the box.  Nothing is sampled.  A
bound proves only what it exceeds by the target's slack (:mod:`rounding`), and a
middle refutes only by as much; NaN and infinity prove nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rrnn_opt.check.plans.collision.boxes import poses
from rrnn_opt.check.plans.collision.look import Effort, look, settle
from rrnn_opt.check.plans.collision.scene import Scene
from rrnn_opt.check.plans.collision.worklist import (
    Batch,
    Leaf,
    Ledger,
    Work,
    divide,
    whole,
)
from rrnn_opt.check.plans.motion import Motion

PROVED, REFUTED, UNKNOWN = "PROVED", "REFUTED", "UNKNOWN"
CHECKS_A_BOX = 100
"""Rows allowed for each box of the budget."""
DEEPEST = 48


@dataclass(frozen=True)
class Outcome:
    """What the subdivision found.

    Attributes:
        verdict: "PROVED", "REFUTED" or "UNKNOWN".
        clearance: proved lower bound of the distance of all pairs, m; None
            when there is no pair or nothing was proved.
        witness: {"time", "q", "pair", "distance"} of a collision, or None.
        checks: number of (box, pair) looked at.
        boxes: number of boxes.
        leaves: what was proved where, None unless asked for.
    """

    verdict: str
    clearance: float | None
    witness: dict[str, Any] | None
    checks: int
    boxes: int
    leaves: list[Leaf] | None = None


def prove_free(scene: Scene, motion: Motion, effort: Effort) -> Outcome:
    """Settle whether all pairs keep apart during the whole motion.

    Args:
        scene: the robot, what must keep apart, and rounding.
        motion: rows and cubics.
        effort: limits and tolerances.
    """
    ledger = Ledger()
    ledger.leaves = [] if effort.keep_leaves else None
    live = [target for target in scene.targets if target.count]
    stack = whole(live, len(motion.unit.h))
    while stack and ledger.witness is None:
        batch = stack.pop()
        now = poses(scene.model, scene.joint, batch.boxes, scene.errors)
        left = look(batch, now, motion, effort, ledger)
        if not left or ledger.witness is not None:
            continue
        if batch.depth >= DEEPEST or _spent(ledger, effort):
            _give_up(batch, left, ledger)
        else:
            stack += divide(batch, left)
    return _outcome(ledger, bool(live))


def _outcome(ledger: Ledger, live: bool) -> Outcome:
    verdict = UNKNOWN if ledger.undecided else PROVED
    if ledger.witness is not None:
        verdict = REFUTED
    shown = ledger.proved if verdict == PROVED and live else None
    return Outcome(
        verdict, shown, ledger.witness, ledger.checks, ledger.boxes, ledger.leaves
    )


def _spent(ledger: Ledger, effort: Effort) -> bool:
    many = ledger.checks >= CHECKS_A_BOX * effort.max_boxes
    return many or ledger.boxes >= effort.max_boxes


def _give_up(batch: Batch, left: list[Work], ledger: Ledger) -> None:
    """No further division: what was shown so far may be enough or not."""
    for item in left:
        settle(item, batch, -np.inf, ledger)
        ledger.undecided |= len(item.box) > 0
