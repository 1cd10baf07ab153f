"""One look at a batch of boxes: what it can refute or prove, and what is left.

All pairs of all boxes are looked at together first, in dense arrays; what the
cheap bound leaves open goes on row by row.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from rrnn_opt.check.plans.collision.boxes import Index, Poses
from rrnn_opt.check.plans.collision.targets import FirstLook, Target
from rrnn_opt.check.plans.collision.worklist import Batch, Leaf, Ledger, Work
from rrnn_opt.check.plans.motion import Motion
from rrnn_opt.check.plans.reading import Array

DEEPEST_FOR_CLEARANCE = 10
GUESSES = 4
"""Solids looked into to tell how near it all comes; decides no verdict."""


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


class _Near(NamedTuple):
    """The nearest coarse row of each solid of a target: distance, box and pair."""

    target: Target
    d: Array
    box: Index
    pair: Index


def look(
    batch: Batch, now: Poses, motion: Motion, effort: Effort, ledger: Ledger
) -> list[Work]:
    """Refute or prove what one look at the boxes can; the rest is returned.

    Args:
        batch: boxes and their open rows.
        now: the robot at the boxes' middles.
        motion: rows and cubics.
        effort: limits and tolerances.
        ledger: what is known so far; what is found goes there.
    """
    ledger.boxes += len(batch.boxes.half)
    work = batch.work
    if batch.fresh:
        work = _opened(_first_look(batch, now, effort, ledger))
    _measure(work, now, ledger)
    while coarse := [item for item in work if item.target.finer is not None]:
        _sift(coarse, batch, now, _wish(batch, effort, ledger), ledger)
        opened = _opened(coarse)
        _measure(opened, now, ledger)
        work = [item for item in work if item.target.finer is None] + opened
    ledger.witness = _witness(work, batch, motion)
    if ledger.witness is not None:
        return []
    _sift(work, batch, now, _wish(batch, effort, ledger), ledger)
    return [item for item in work if len(item.box)]


def _first_look(batch: Batch, now: Poses, effort: Effort, ledger: Ledger) -> list[Work]:
    """All pairs in all boxes: what even the sharp bounds leave open."""
    looks = [(target, target.first(now)) for target in batch.fresh]
    ledger.checks += sum(found.d.size for _, found in looks)
    _guess([_nearest_of_all(*pair) for pair in looks], now, ledger)
    wish = _wish(batch, effort, ledger)
    work = [_left(target, found, batch, wish, ledger) for target, found in looks]
    for item in work:
        _sharpen(item, batch, now, wish, ledger)
    return work


def _left(
    target: Target, found: FirstLook, batch: Batch, wish: float, ledger: Ledger
) -> Work:
    """The rows that a first look does not settle; the others are settled."""
    room = target.slack[:, None, None]
    done = found.shown >= np.maximum(target.required + room, wish)
    _lower(float(np.where(done, found.shown - room, np.inf).min()), ledger)
    boxes = found.d.shape[2]
    if ledger.leaves is not None:
        pair, box = np.divmod(np.flatnonzero(done), boxes)
        ledger.leaves.append(Leaf(target, batch.boxes, box, pair, found.shown[done]))
    pair, box = np.divmod(np.flatnonzero(~done), boxes)
    return Work(target, box, pair, found.shown[~done], found.d[~done])


def _nearest_of_all(target: Target, found: FirstLook) -> _Near:
    solids, own, boxes = found.d.shape
    rows = found.d.reshape(solids, -1)
    best = np.argmin(rows, axis=1)
    every = np.arange(solids)
    pair, box = np.divmod(best, boxes)
    return _Near(target, rows[every, best], box, pair + own * every)


def _guess(coarse: Sequence[_Near], now: Poses, ledger: Ledger) -> None:
    """Look into the nearest coarse rows: tells how near it all comes."""
    every = np.concatenate([near.d for near in coarse])
    chosen = np.zeros(len(every), dtype=bool)
    chosen[np.argsort(every, kind="stable")[:GUESSES]] = True
    ends = np.cumsum([len(near.d) for near in coarse])
    for near, mine in zip(coarse, np.split(chosen, ends[:-1]), strict=True):
        if not mine.any():
            continue
        none = np.full(int(mine.sum()), -np.inf)
        item = Work(near.target, near.box[mine], near.pair[mine], none).taken_apart()
        item.d = item.target.distance(now, item.box, item.pair)
        while item.target.finer is not None:
            item.keep([int(np.argmin(item.d))])
            item = item.taken_apart()
            item.d = item.target.distance(now, item.box, item.pair)
        ledger.nearest = min(ledger.nearest, float(item.d.min()))


def _wish(batch: Batch, effort: Effort, ledger: Ledger) -> float:
    """A bound this high need not be improved; it decides no verdict."""
    near, tighten = ledger.nearest, batch.depth < DEEPEST_FOR_CLEARANCE
    return near - max(effort.resolution, 0.1 * abs(near)) if tighten else -np.inf


def _opened(coarse: list[Work]) -> list[Work]:
    return [item.taken_apart() for item in coarse if len(item.box)]


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
        lacking = item.d - item.target.required + item.target.room(item.pair)
        row = int(np.argmin(lacking))
        if lacking[row] < worst:
            worst, found = float(lacking[row]), (item, row)
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
        travel = item.target.travel(now, item.box, item.pair)
        floor = item.target.floor(now, item.box, item.pair, item.d)
        item.shown = np.maximum(item.shown, floor - travel)
        settle(item, batch, wish, ledger)
        _sharpen(item, batch, now, wish, ledger)


def _sharpen(item: Work, batch: Batch, now: Poses, wish: float, ledger: Ledger) -> None:
    if len(item.box):
        sharp = item.target.sharp(now, item.box, item.pair)
        item.shown = np.fmax(item.shown, sharp)
        settle(item, batch, wish, ledger)


def settle(item: Work, batch: Batch, wish: float, ledger: Ledger) -> None:
    """Enter the rows that are proved, and shown to be as far as wished.

    Args:
        item: the open rows; those left stay.
        batch: of their boxes.
        wish: the bound need not be higher, m.
        ledger: what is known so far; what is found goes there.
    """
    room = item.target.room(item.pair)
    done = item.shown >= np.maximum(item.target.required + room, wish)
    if not done.any():
        return
    _lower(float((item.shown - room)[done].min()), ledger)
    if ledger.leaves is not None:
        rows = item.box[done], item.pair[done], item.shown[done]
        ledger.leaves.append(Leaf(item.target, batch.boxes, *rows))
    item.keep(~done)


def _lower(least: float, ledger: Ledger) -> None:
    ledger.proved = min(ledger.proved, float(np.nextafter(least, -np.inf)))
