"""Freedom from collision for all times, by subdivision in time.

Every (box, pair) is either proved by a bound over the whole box, refuted by
the box's middle, or handed to both halves of the box.  Nothing is sampled.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rrnn_opt.check.boxes import Boxes, Index, Poses, joint_pieces, poses
from rrnn_opt.check.hermite import Pieces
from rrnn_opt.check.model import Model
from rrnn_opt.check.reading import Array
from rrnn_opt.check.targets import Target

PROVED, REFUTED, UNKNOWN = "PROVED", "REFUTED", "UNKNOWN"
CHUNK = 256
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


@dataclass
class _Ledger:
    """What is known so far, over all chunks."""

    proved: float = np.inf
    nearest: float = np.inf
    undecided: bool = False
    checks: int = 0
    boxes: int = 0
    witness: dict[str, Any] | None = None


@dataclass
class _Work:
    """Undecided (box, pair) rows of one target, with bounds shown so far."""

    target: Target
    box: Index
    pair: Index
    shown: Array
    d: Array = field(default_factory=lambda: np.zeros(0))
    n: Array = field(default_factory=lambda: np.zeros((0, 3)))

    def keep(self, chosen: Any) -> None:
        """Drop all rows but the chosen ones."""
        self.box, self.pair = self.box[chosen], self.pair[chosen]
        self.shown, self.d, self.n = self.shown[chosen], self.d[chosen], self.n[chosen]


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
    ledger, joint = _Ledger(), joint_pieces(model, motion.pieces)
    live = [target for target in targets if target.count]
    for first in range(0, len(motion.pieces.h) if live else 0, CHUNK):
        last = min(first + CHUNK, len(motion.pieces.h))
        _chunk(model, live, (motion, joint), (first, last), effort, ledger)
        if ledger.witness is not None:
            break
    verdict = PROVED
    if ledger.witness is not None:
        verdict = REFUTED
    elif ledger.undecided:
        verdict = UNKNOWN
    shown = ledger.proved if verdict == PROVED and live else None
    return Outcome(verdict, shown, ledger.witness, ledger.checks, ledger.boxes)


def _chunk(
    model: Model,
    targets: Sequence[Target],
    motions: tuple[Motion, Pieces],
    span: tuple[int, int],
    effort: Effort,
    ledger: _Ledger,
) -> None:
    motion, joint = motions
    boxes = Boxes.whole(motion.pieces, *span)
    work = [_everything(target, len(boxes.half)) for target in targets]
    for depth in range(DEEPEST):
        now = poses(model, joint, boxes)
        _measure(work, now, ledger)
        ledger.boxes += len(boxes.half)
        ledger.witness = _witness(work, boxes, motion, effort)
        if ledger.witness is not None:
            return
        work = _sift(work, now, effort, ledger, depth < DEEPEST_FOR_CLEARANCE)
        if not work or ledger.boxes >= effort.max_boxes:
            break
        boxes, work = _divide(boxes, work)
    for item in work:  # budget or depth spent: some may be good enough
        enough = item.shown >= item.target.required + effort.slack
        ledger.undecided |= not bool(np.all(enough))
        ledger.proved = min(ledger.proved, float(item.shown.min()))


def _everything(target: Target, n: int) -> _Work:
    box = np.repeat(np.arange(n), target.count)
    pair = np.tile(np.arange(target.count), n)
    return _Work(target, box, pair, np.full(len(box), -np.inf))


def _measure(work: list[_Work], now: Poses, ledger: _Ledger) -> None:
    for item in work:
        item.d, item.n = item.target.distance(now, item.box, item.pair)
        ledger.checks += len(item.d)
        ledger.nearest = min(ledger.nearest, float(item.d.min()))


def _witness(
    work: list[_Work], boxes: Boxes, motion: Motion, effort: Effort
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
    work: list[_Work], now: Poses, effort: Effort, ledger: _Ledger, tighten: bool
) -> list[_Work]:
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
            sharp = item.target.sharp(now, item.box, item.pair, item.n)
            item.shown = np.fmax(item.shown, sharp)
            _settle(item, need, ledger)
        if len(item.box):
            left.append(item)
    return left


def _settle(item: _Work, need: float, ledger: _Ledger) -> None:
    done = item.shown >= need
    if done.any():
        ledger.proved = min(ledger.proved, float(item.shown[done].min()))
        item.keep(~done)


def _divide(boxes: Boxes, work: list[_Work]) -> tuple[Boxes, list[_Work]]:
    chosen = np.unique(np.concatenate([item.box for item in work]))
    rank = np.zeros(len(boxes.half), dtype=np.int64)
    rank[chosen] = np.arange(len(chosen))
    for item in work:
        item.box = (2 * rank[item.box][:, None] + np.array([0, 1])).ravel()
        item.pair = np.repeat(item.pair, 2)
        item.shown = np.repeat(item.shown, 2)
    return boxes.halves(chosen), work
