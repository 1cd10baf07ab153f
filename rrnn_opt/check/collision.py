"""Freedom from collision for all times, by subdivision in time.

Every (box, pair) is either proved by a bound over the whole box, refuted by
the box's middle, or handed to both halves of the box.  Nothing is sampled.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rrnn_opt.check.boxes import Boxes, Poses, joint_pieces, poses
from rrnn_opt.check.hermite import Pieces
from rrnn_opt.check.model import Model
from rrnn_opt.check.reading import Array
from rrnn_opt.check.targets import Target
from rrnn_opt.check.worklist import Batch, Ledger, Work, divide, whole

PROVED, REFUTED, UNKNOWN = "PROVED", "REFUTED", "UNKNOWN"
CHECKS_A_BOX = 100
"""Rows allowed for each box of the budget."""
DEEPEST = 48
DEEPEST_FOR_CLEARANCE = 10


@dataclass(frozen=True)
class Effort:
    """How hard to try.

    Attributes:
        max_boxes: time boxes that may be looked at.
        slack: absorbs rounding, m; a proof needs this much more than asked.
        resolution: the clearance bound is refined to within this of the truth,
            or a tenth of it, m.
    """

    max_boxes: int
    slack: float
    resolution: float = 1e-3


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
    """

    verdict: str
    clearance: float | None
    witness: dict[str, Any] | None
    checks: int
    boxes: int


@dataclass(frozen=True, eq=False)
class Motion:
    """A timed motion in the checker's own terms.

    Attributes:
        t: (n,), s.
        q: (n, nv).
        pieces: cubics of the coordinates.
    """

    t: Array
    q: Array
    pieces: Pieces


def prove_free(
    model: Model, targets: Sequence[Target], motion: Motion, effort: Effort
) -> Outcome:
    """Settle whether all pairs keep apart during the whole motion.

    Args:
        model: the robot.
        targets: what must keep apart.
        motion: rows and cubics.
        effort: limits and tolerances.
    """
    ledger, joint = Ledger(), joint_pieces(model, motion.pieces)
    live = [target for target in targets if target.count]
    stack = whole(live, len(motion.pieces.h), motion.pieces)
    while stack and ledger.witness is None:
        batch = stack.pop()
        left = _look(batch, poses(model, joint, batch.boxes), motion, effort, ledger)
        if not left or ledger.witness is not None:
            continue
        if batch.depth >= DEEPEST or _spent(ledger, effort):
            _give_up(left, effort, ledger)
        else:
            stack += divide(batch, left)
    verdict = UNKNOWN if ledger.undecided else PROVED
    if ledger.witness is not None:
        verdict = REFUTED
    shown = ledger.proved if verdict == PROVED and live else None
    return Outcome(verdict, shown, ledger.witness, ledger.checks, ledger.boxes)


def _spent(ledger: Ledger, effort: Effort) -> bool:
    many = ledger.checks >= CHECKS_A_BOX * effort.max_boxes
    return many or ledger.boxes >= effort.max_boxes


def _give_up(left: list[Work], effort: Effort, ledger: Ledger) -> None:
    """No further division: what was shown so far may be enough or not."""
    for item in left:
        enough = item.shown >= item.target.required + effort.slack
        ledger.undecided |= not bool(np.all(enough))
        ledger.proved = min(ledger.proved, float(item.shown.min()))


def _look(
    batch: Batch, now: Poses, motion: Motion, effort: Effort, ledger: Ledger
) -> list[Work]:
    """Refute or prove what one look at the boxes can; the rest is returned."""
    ledger.boxes += len(batch.boxes.half)
    _measure(batch.work, now, ledger)
    ledger.witness = _witness(batch.work, batch.boxes, motion, effort)
    if ledger.witness is not None:
        return []
    return _sift(batch.work, now, effort, ledger, batch.depth < DEEPEST_FOR_CLEARANCE)


def _measure(work: list[Work], now: Poses, ledger: Ledger) -> None:
    for item in work:
        item.d = item.target.distance(now, item.box, item.pair)
        ledger.checks += len(item.d)
        ledger.nearest = min(ledger.nearest, float(item.d.min()))


def _witness(
    work: list[Work], boxes: Boxes, motion: Motion, effort: Effort
) -> dict[str, Any] | None:
    """The worst collision among the middles, or None."""
    worst, found = -effort.slack, None
    for item in work:
        row = int(np.argmin(item.d))
        lacking = float(item.d[row]) - item.target.required
        if lacking < worst:
            worst, found = lacking, (item, row)
    if found is None:
        return None
    item, row = found
    box = item.box[row]
    piece, s = int(boxes.piece[box]), float(boxes.middle[box])
    p = motion.pieces
    q = p.c0[piece] + s * (p.c1[piece] + s * (p.c2[piece] + s * p.c3[piece]))
    return {
        "time": float(motion.t[piece] + s),
        "q": [float(x) for x in q],
        "pair": item.target.label(int(item.pair[row])),
        "distance": float(item.d[row]),
        "required": item.target.required,
    }


def _sift(
    work: list[Work], now: Poses, effort: Effort, ledger: Ledger, tighten: bool
) -> list[Work]:
    """Prove what can be proved; what is left goes to both halves."""
    near = ledger.nearest
    wish = near - max(effort.resolution, 0.1 * abs(near)) if tighten else -np.inf
    left = []
    for item in work:
        need = max(item.target.required + effort.slack, wish)
        travel = item.target.travel(now)[item.box, item.pair]
        item.shown = np.maximum(item.shown, item.d - travel)
        _settle(item, need, ledger)
        if len(item.box):
            sharp = item.target.sharp(now, item.box, item.pair)
            item.shown = np.fmax(item.shown, sharp)
            _settle(item, need, ledger)
        if len(item.box):
            left.append(item)
    return left


def _settle(item: Work, need: float, ledger: Ledger) -> None:
    done = item.shown >= need
    if done.any():
        ledger.proved = min(ledger.proved, float(item.shown[done].min()))
        item.keep(~done)
