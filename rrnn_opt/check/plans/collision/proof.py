"""Freedom from collision for all times, by subdivision in time.

Every (box, pair) is either proved by a bound over the whole box, refuted by
the box's middle, or handed to both halves of the box.  Nothing is sampled.  A
bound proves only what it exceeds by the target's slack (:mod:`rounding`), and a
middle refutes only by as much; NaN and infinity prove nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rrnn_opt.check.plans.collision.boxes import Poses, joint_pieces, poses
from rrnn_opt.check.plans.collision.rounding import Rounding
from rrnn_opt.check.plans.collision.targets import Target
from rrnn_opt.check.plans.collision.worklist import (
    Batch,
    Leaf,
    Ledger,
    Work,
    divide,
    whole,
)
from rrnn_opt.check.plans.motion import Motion
from rrnn_opt.check.plans.robot.model import Model

PROVED, REFUTED, UNKNOWN = "PROVED", "REFUTED", "UNKNOWN"
CHECKS_A_BOX = 100
"""Rows allowed for each box of the budget."""
DEEPEST = 48
DEEPEST_FOR_CLEARANCE = 10
GUESSES = 4
"""Targets looked into to tell how near it all comes; decides no verdict."""


@dataclass(frozen=True)
class Effort:
    """How hard to try.

    Attributes:
        max_boxes: time boxes that may be looked at.
        resolution: the clearance bound is refined to within this of the truth,
            or a tenth of it, m.
        keep_leaves: report what was proved where.
    """

    max_boxes: int
    resolution: float = 1e-3
    keep_leaves: bool = False


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


def prove_free(
    model: Model,
    targets: Sequence[Target],
    errors: Rounding,
    motion: Motion,
    effort: Effort,
) -> Outcome:
    """Settle whether all pairs keep apart during the whole motion.

    Args:
        model: the robot.
        targets: what must keep apart.
        errors: rounding of the robot's own numbers.
        motion: rows and cubics.
        effort: limits and tolerances.
    """
    ledger, joint = Ledger(), joint_pieces(model, motion.unit)
    ledger.leaves = [] if effort.keep_leaves else None
    live = [target for target in targets if target.count]
    stack = whole(live, len(motion.unit.h))
    while stack and ledger.witness is None:
        batch = stack.pop()
        now = poses(model, joint, batch.boxes, errors)
        left = _look(batch, now, motion, effort, ledger)
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
        _settle(item, batch, item.target.required + item.target.slack, ledger)
        ledger.undecided |= len(item.box) > 0


def _look(
    batch: Batch, now: Poses, motion: Motion, effort: Effort, ledger: Ledger
) -> list[Work]:
    """Refute or prove what one look at the boxes can; the rest is returned."""
    ledger.boxes += len(batch.boxes.half)
    tighten = batch.depth < DEEPEST_FOR_CLEARANCE
    work = batch.work
    _measure(work, now, ledger)
    while coarse := [item for item in work if item.target.finer is not None]:
        _guess(coarse, now, ledger)
        _sift(coarse, batch, now, _wish(effort, ledger, tighten), ledger)
        opened = [item.taken_apart(slice(None)) for item in coarse if len(item.box)]
        _measure(opened, now, ledger)
        work = [item for item in work if item.target.finer is None] + opened
    ledger.witness = _witness(work, batch, motion)
    if ledger.witness is not None:
        return []
    _sift(work, batch, now, _wish(effort, ledger, tighten), ledger)
    return [item for item in work if len(item.box)]


def _guess(coarse: list[Work], now: Poses, ledger: Ledger) -> None:
    """Look into the nearest coarse rows: tells how near it all comes."""
    nearest = sorted(coarse, key=lambda item: float(item.d.min()))
    for item in nearest[:GUESSES]:
        while item.target.finer is not None:
            item = item.taken_apart(np.array([int(np.argmin(item.d))]))
            item.d = item.target.distance(now, item.box, item.pair)
        ledger.nearest = min(ledger.nearest, float(item.d.min()))


def _wish(effort: Effort, ledger: Ledger, tighten: bool) -> float:
    """A bound this high need not be improved; it decides no verdict."""
    near = ledger.nearest
    return near - max(effort.resolution, 0.1 * abs(near)) if tighten else -np.inf


def _measure(work: list[Work], now: Poses, ledger: Ledger) -> None:
    for item in work:
        item.d = item.target.distance(now, item.box, item.pair)
        ledger.checks += len(item.d)
        if item.target.finer is None and len(item.d):
            ledger.nearest = min(ledger.nearest, float(item.d.min()))


def _witness(work: list[Work], batch: Batch, motion: Motion) -> dict[str, Any] | None:
    """The worst collision among the middles, or None."""
    worst, found = 0.0, None
    for item in work:
        row = int(np.argmin(item.d))
        lacking = float(item.d[row]) - item.target.required + item.target.slack
        if lacking < worst:
            worst, found = lacking, (item, row)
    if found is None:
        return None
    item, row = found
    box = item.box[row]
    piece, s = int(batch.boxes.piece[box]), float(batch.boxes.middle[box])
    p, h = motion.unit, float(motion.t[piece + 1] - motion.t[piece])
    q = p.c0[piece] + s * (p.c1[piece] + s * (p.c2[piece] + s * p.c3[piece]))
    return {
        "time": float(motion.t[piece] + s * h),
        "q": [float(x) for x in q],
        "pair": item.target.label(int(item.pair[row])),
        "distance": float(item.d[row]),
        "required": item.target.required,
    }


def _sift(
    work: list[Work], batch: Batch, now: Poses, wish: float, ledger: Ledger
) -> None:
    """Prove what can be proved; what is left stays in the work."""
    for item in work:
        need = max(item.target.required + item.target.slack, wish)
        travel = item.target.travel(now, item.box, item.pair)
        floor = item.target.floor(now, item.box, item.pair, item.d)
        item.shown = np.maximum(item.shown, floor - travel)
        _settle(item, batch, need, ledger)
        if len(item.box):
            sharp = item.target.sharp(now, item.box, item.pair)
            item.shown = np.fmax(item.shown, sharp)
            _settle(item, batch, need, ledger)


def _settle(item: Work, batch: Batch, need: float, ledger: Ledger) -> None:
    done = item.shown >= need
    if not done.any():
        return
    least = float(item.shown[done].min()) - item.target.slack
    ledger.proved = min(ledger.proved, float(np.nextafter(least, -np.inf)))
    if ledger.leaves is not None:
        rows = item.box[done], item.pair[done], item.shown[done]
        ledger.leaves.append(Leaf(item.target, batch.boxes, *rows))
    item.keep(~done)
