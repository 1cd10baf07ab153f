"""The open rows (box, pair) of the subdivision, in batches that fit in memory."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from rrnn_opt.check.plans.collision.boxes import Boxes, Index
from rrnn_opt.check.plans.collision.targets import Target
from rrnn_opt.check.plans.reading import Array

ROWS = 200_000
"""Rows (box, pair) at a time: bounds memory, decides nothing."""


class Leaf(NamedTuple):
    """Rows of one target that were proved, each over its whole box.

    Attributes:
        target: whose pairs they are.
        boxes: the boxes.
        box: row of ``boxes``, (M,).
        pair: (M,).
        shown: the bound that was found, (M,), m.
    """

    target: Target
    boxes: Boxes
    box: Index
    pair: Index
    shown: Array


@dataclass
class Ledger:
    """What is known so far, over all batches.

    Attributes:
        proved: least bound among the rows settled, rounding taken off, m.
        nearest: least distance met at the middle of a box, m.
        undecided: some row was given up.
        checks: rows looked at.
        boxes: boxes looked at.
        witness: of a collision, or None.
        leaves: what was proved where, if it is to be kept.
    """

    proved: float = np.inf
    nearest: float = np.inf
    undecided: bool = False
    checks: int = 0
    boxes: int = 0
    witness: dict[str, Any] | None = None
    leaves: list[Leaf] | None = None


@dataclass
class Work:
    """Undecided (box, pair) rows of one target.

    Attributes:
        target: whose pairs they are.
        box: (M,).
        pair: (M,).
        shown: best lower bound of the distance over the box so far, (M,), m.
        d: distance at the middle of the box, (M,), m.
    """

    target: Target
    box: Index
    pair: Index
    shown: Array
    d: Array = field(default_factory=lambda: np.zeros(0))

    def keep(self, chosen: Any) -> None:
        """Drop all rows but the chosen ones."""
        self.box, self.pair = self.box[chosen], self.pair[chosen]
        self.shown, self.d = self.shown[chosen], self.d[chosen]

    def halved(self, rank: Index) -> Work:
        """Rows of both halves of the boxes with a rank >= 0, renumbered by it."""
        mine = rank[self.box] >= 0
        first = 2 * rank[self.box[mine]]
        box = (first[:, None] + np.array([0, 1])).ravel()
        pair, shown = np.repeat(self.pair[mine], 2), np.repeat(self.shown[mine], 2)
        return Work(self.target, box, pair, shown)

    def taken_apart(self) -> Work:
        """The finer target's rows; the same ones where there is none."""
        finer = self.target.finer
        if finer is None:
            return self
        box, pair = finer.rows(self.box, self.pair)
        return Work(finer.target, box, pair, np.full(len(box), -np.inf))


@dataclass(frozen=True, eq=False)
class Batch:
    """Boxes and the rows that are still open in them.

    Attributes:
        boxes: the boxes.
        work: open rows.
        depth: how often the boxes were halved.
        fresh: targets whose pairs are all open.
    """

    boxes: Boxes
    work: list[Work]
    depth: int
    fresh: tuple[Target, ...] = ()


def whole(live: list[Target], n: int) -> list[Batch]:
    """All pieces against all targets, few enough at a time; the first on top."""
    if not live:
        return []
    size = max(1, ROWS // sum(target.count for target in live))
    batches = []
    for first in range(0, n, size):
        boxes = Boxes.whole(first, min(first + size, n))
        batches.append(Batch(boxes, [], 0, tuple(live)))
    return batches[::-1]


def divide(batch: Batch, work: list[Work]) -> list[Batch]:
    """Both halves of every box that is still needed, few enough rows at a time."""
    chosen = np.unique(np.concatenate([item.box for item in work]))
    rows = sum(len(item.box) for item in work)
    parts = min(len(chosen), -(-2 * rows // ROWS))
    batches = []
    for part in np.array_split(chosen, parts):
        rank = np.full(len(batch.boxes.half), -1)
        rank[part] = np.arange(len(part))
        halves = [item.halved(rank) for item in work]
        kept = [item for item in halves if len(item.box)]
        batches.append(Batch(batch.boxes.halves(part), kept, batch.depth + 1))
    return batches[::-1]
