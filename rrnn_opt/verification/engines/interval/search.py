"""Branch and bound over boxes, a level of the tree at a time.

A box is done when every goal element has its sense all over it, or some
hypothesis is broken all over it.  Otherwise it is cut in two along the unknown
that spreads the undecided elements most.  Boxes of one level are independent:
they are shared out among threads (the kernels run outside Python's lock).
"""

from __future__ import annotations

import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.verification.engines.interval.forms import Forms, middle
from rrnn_opt.verification.engines.interval.kernel import BATCH, Array, Enclosure
from rrnn_opt.verification.engines.interval.senses import breaks, keeps
from rrnn_opt.verification.engines.interval.tree import MEAN_VALUE, NATURAL, OPEN, Codes

Mask = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Question:
    """What is asked of every box.

    Attributes:
        forms: enclosures of all elements.
        senses: ">=0", ">0", "<=0", "<0" or "==0", one an element.
        goals: how many of the first elements are the goal; the others are
            hypotheses.
    """

    forms: Forms
    senses: tuple[str, ...]
    goals: int


@dataclass(frozen=True)
class Budget:
    """How long to go on.

    Attributes:
        seconds: wall time, s.
        boxes: boxes looked at.
        jobs: threads.
    """

    seconds: float = 10.0
    boxes: int = 5_000_000
    jobs: int = 1


@dataclass
class Outcome:
    """What a search found.

    Attributes:
        levels: codes of the proof tree, level by level.
        boxes: boxes looked at.
        lower: lower ends of what stayed open, (n, R).
        upper: upper ends, (n, R).
        breach: a point where floating point breaks the goal, (n,), or None.
        cause: why boxes stayed open; "" when none did.
    """

    levels: list[Codes] = field(default_factory=list)
    boxes: int = 0
    lower: Array = field(default_factory=lambda: np.zeros((0, 0)))
    upper: Array = field(default_factory=lambda: np.zeros((0, 0)))
    breach: Array | None = None
    cause: str = ""

    @property
    def proved(self) -> bool:
        """Whether nothing stayed open."""
        return self.breach is None and not self.cause


class _Part(NamedTuple):
    codes: Codes
    breach: Array | None


def search(
    question: Question, lower: Array, upper: Array, budget: Budget | None = None
) -> Outcome:
    """Show that the hypotheses imply the goal all over one box.

    Args:
        question: the elements and their senses.
        lower: lower ends of the box, (n,).
        upper: upper ends, (n,).
        budget: when to stop.

    Returns:
        A proof tree, a point that breaks the goal, or the open boxes.
    """
    budget = budget or Budget()
    out, end = Outcome(), time.monotonic() + budget.seconds
    low, high = lower[:, None].copy(), upper[:, None].copy()
    with ThreadPoolExecutor(max(1, budget.jobs)) as pool:
        while low.shape[1]:
            codes, out.breach = _level(question, low, high, pool, end)
            out.boxes += len(codes)
            out.levels.append(codes)
            if out.breach is not None:
                return out
            cut = codes < OPEN
            spent = time.monotonic() > end or out.boxes > budget.boxes
            if np.any(codes == OPEN) or (spent and cut.any()):
                return _stopped(out, low, high, question, spent)
            low, high = halved(low[:, cut], high[:, cut], codes[cut])
    return out


def halved(low: Array, high: Array, axes: Codes) -> tuple[Array, Array]:
    """Both halves of every box, side by side."""
    count = low.shape[1]
    low, high = np.repeat(low, 2, axis=1), np.repeat(high, 2, axis=1)
    rows, first = axes.astype(np.intp), 2 * np.arange(count)
    cut = middle(low[rows, first], high[rows, first])
    high[rows, first] = cut
    low[rows, first + 1] = cut
    return low, high


def _level(
    question: Question, low: Array, high: Array, pool: ThreadPoolExecutor, end: float
) -> tuple[Codes, Array | None]:
    parts = range(0, low.shape[1], BATCH)

    def one(start: int) -> _Part:
        part = slice(start, start + BATCH)
        if time.monotonic() > end + 1.0:  # a last level may be a long one
            width = len(range(*part.indices(low.shape[1])))
            return _Part(np.full(width, OPEN, np.uint8), None)
        return _decided(question, low[:, part], high[:, part])

    results = list(pool.map(one, parts))
    breaches = [r.breach for r in results if r.breach is not None]
    codes = np.concatenate([r.codes for r in results])
    return codes, breaches[0] if breaches else None


def _decided(question: Question, low: Array, high: Array) -> _Part:
    forms = question.forms
    natural = forms.value(low, high)
    codes = np.full(low.shape[1], OPEN, np.uint8)
    codes[_done(question, natural)] = NATURAL
    left = np.flatnonzero(codes == OPEN)
    if not len(left):
        return _Part(codes, None)
    low, high = low[:, left], high[:, left]
    enclosure = natural_at(natural, left)
    spread = None
    if forms.slope is not None:
        enclosure, spread = forms.mean_value(low, high, enclosure)
    done = _done(question, enclosure)
    codes[left[done]] = MEAN_VALUE
    still = ~done
    axes = _axes(question, enclosure, spread, low, high)
    codes[left[still]] = axes[still]
    return _Part(codes, _breach(question, low[:, still], high[:, still]))


def natural_at(enclosure: Enclosure, chosen: NDArray[np.intp]) -> Enclosure:
    """The enclosures of some of the boxes."""
    lower, upper = enclosure.lower[:, chosen], enclosure.upper[:, chosen]
    return Enclosure(lower, upper, enclosure.bounded[chosen])


def _done(question: Question, enclosure: Enclosure) -> Mask:
    """The goal holds all over a box, or a hypothesis fails all over it."""
    kept = keeps(enclosure.lower, enclosure.upper, question.senses)
    broken = breaks(enclosure.lower, enclosure.upper, question.senses)
    goal = kept[: question.goals].all(axis=0)
    empty = broken[question.goals :].any(axis=0)
    done: Mask = (goal | empty) & enclosure.bounded
    return done


def _axes(
    question: Question,
    enclosure: Enclosure,
    spread: Array | None,
    low: Array,
    high: Array,
) -> Codes:
    """The unknown to cut; OPEN where no cut makes a box smaller."""
    width = high - low
    score = width / np.max(np.abs(width), axis=0, initial=1e-300) * 1e-9
    if spread is not None:
        kept = keeps(enclosure.lower, enclosure.upper, question.senses)
        total = spread.sum(axis=1)
        weigh = ~kept & np.isfinite(total) & (total > 0.0)
        with np.errstate(invalid="ignore", divide="ignore"):
            share = np.where(weigh[:, None], spread / total[:, None], 0.0)
        score = score + share.sum(axis=0)
    centre = middle(low, high)
    score[(centre <= low) | (centre >= high)] = -1.0
    axes = np.argmax(score, axis=0)
    stuck = np.max(score, axis=0) < 0.0
    return np.where(stuck, OPEN, axes).astype(np.uint8)


def _breach(question: Question, low: Array, high: Array) -> Array | None:
    """A middle at which the goal is broken and every hypothesis kept."""
    if not low.shape[1]:
        return None
    centre = middle(low, high)
    at = question.forms.value(centre, centre)
    broken = breaks(at.lower, at.upper, question.senses)[: question.goals].any(axis=0)
    kept = keeps(at.lower, at.upper, question.senses)[question.goals :].all(axis=0)
    found = np.flatnonzero(broken & kept & at.bounded)
    return centre[:, found[0]] if len(found) else None


def _stopped(
    out: Outcome, low: Array, high: Array, question: Question, spent: bool
) -> Outcome:
    """Mark what is open and name the most frequent reason."""
    codes = out.levels[-1]
    left = codes <= OPEN
    out.lower, out.upper = low[:, left], high[:, left]
    bounded = question.forms.value(out.lower, out.upper).bounded
    if np.mean(bounded) < 0.5:
        out.cause = "the graph is not defined, or not bounded, on most of what is open"
    elif spent:
        out.cause = "the budget is spent"
    else:
        out.cause = "boxes as small as doubles go stay open: the claim is tight there"
    out.levels[-1] = np.where(left, OPEN, codes).astype(np.uint8)
    return out
