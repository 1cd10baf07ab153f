"""A seeded search for points that break a claim.

What it finds are candidates in floating point, worst first.  They prove
nothing until the checker has replayed them.  A breach no larger than rounding
is not offered: it speaks of the constants' last bits.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from rrnn_opt.claim import Claim
from rrnn_opt.errors import UndecidedError
from rrnn_opt.verification.document import certificate_document

Array = NDArray[np.float64]
Point = dict[str, list[Fraction]]

_WIDTH = 4.0  # half the spread of a variable without bounds
_STEPS = (0.5, 0.1, 0.02)
_DENOMINATORS = (1, 4, 64)
_NOISE = 1e-9  # what floating point may break by rounding alone
_NEAR = 0.05  # a strict goal breaks where it is 0: perhaps at a rounded neighbour


def candidates(
    claim: Claim, *, seed: int = 0, samples: int = 128, starts: int = 4
) -> Iterator[Point]:
    """Points in the domain that break the goal in floating point.

    Args:
        claim: the claim.
        seed: of the generator.
        samples: points of the first sweep.
        starts: how many of them are improved and offered.

    Yields:
        Points; the same one in simpler numbers first, where that is possible.
    """
    rng = np.random.default_rng(seed)
    score = _Score(claim)
    threshold = _threshold(claim)
    lower, upper = _box(claim)
    points = [_draw(rng, lower, upper) for _ in range(samples)]
    points.sort(key=score, reverse=True)
    for start in points[:starts]:
        best = _improved(start, score, rng, lower, upper)
        for point in _simpler(best, lower, upper):
            if score(point) > threshold:
                yield _named(claim, point)


def propose(claim: Claim, *, budget_s: float, seed: int) -> Iterator[dict[str, Any]]:
    """Certificates that ask to replay the candidates.

    Raises:
        UndecidedError: nothing was found, or nothing can be replayed.
    """
    worded = [h.id for h in claim.hypotheses if h.relation is None]
    if worded:
        named = ", ".join(worded)
        raise UndecidedError(f"hypotheses in words only ({named}) cannot be replayed")
    found = False
    for point in itertools.islice(candidates(claim, seed=seed), 64):
        found = True
        yield certificate_document(claim, "replay", witness=point)
    if not found:
        raise UndecidedError("no point found that breaks the goal")


def keepers(claim: Claim, *, seed: int = 0, samples: int = 256) -> Iterator[Point]:
    """Points in the domain that keep the hypotheses in floating point."""
    rng = np.random.default_rng(seed)
    score = _Score(claim)
    lower, upper = _box(claim)
    for _ in range(samples):
        for point in _simpler(_draw(rng, lower, upper), lower, upper):
            if score.keeps(point):
                yield _named(claim, point)
                break


def worth_replaying(claim: Claim, point: Point) -> bool:
    """Whether a point breaks the goal by more than rounding of the constants."""
    column = [float(x) for symbol in claim.variables for x in point[symbol.name]]
    return _Score(claim).excess(np.array(column)) > _threshold(claim)


def _threshold(claim: Claim) -> float:
    return -_NEAR if claim.goal.strict else _NOISE


class _Score:
    """How far a point breaks the goal; -inf where it is of no use."""

    def __init__(self, claim: Claim) -> None:
        self._relations = claim.relations
        x = [ca.vec(s.sx) for s in claim.variables]
        y = [ca.vec(r.expression) for r in claim.relations]
        flat = ca.SX.sym("x", sum(s.size for s in claim.variables))
        parts = ca.vertsplit(flat, [0, *np.cumsum([s.size for s in claim.variables])])
        self._function = ca.Function("score", [flat], ca.substitute(y, x, parts))

    def _breaches(self, point: Array) -> list[float]:
        results = self._function.call([ca.DM(point)])
        values = [np.asarray(v, dtype=np.float64).ravel() for v in results]
        return [
            _breach(v, r.sense) for v, r in zip(values, self._relations, strict=True)
        ]

    def keeps(self, point: Array) -> bool:
        """Whether the point keeps every hypothesis, and the goal is defined."""
        breaks = self._breaches(point)
        return bool(np.all(np.isfinite(breaks))) and max(breaks[1:], default=0) <= 0

    def excess(self, point: Array) -> float:
        """How far the goal is broken, whatever becomes of the hypotheses."""
        return self._breaches(point)[0]

    def __call__(self, point: Array) -> float:
        """Positive when the goal is broken and every hypothesis is kept."""
        breaks = self._breaches(point)
        if not all(np.isfinite(breaks)):
            return -np.inf
        kept = max(breaks[1:], default=0.0)
        return breaks[0] if kept <= 0.0 else -kept - 1e6


def _breach(values: Array, sense: str) -> float:
    if sense == "==0":
        return float(np.max(np.abs(values)))
    return float(np.max(-values if sense in (">=0", ">0") else values))


def _box(claim: Claim) -> tuple[Array, Array]:
    """Bounds of all variables in one column; infinite where there are none."""
    lower, upper = [], []
    for symbol in claim.variables:
        low, high = np.full(symbol.size, -np.inf), np.full(symbol.size, np.inf)
        for interval in claim.domain:
            if interval.variable == symbol.name:
                for k, (a, b) in enumerate(
                    zip(interval.lower, interval.upper, strict=True)
                ):
                    low[k] = low[k] if a is None else max(low[k], float(a))
                    high[k] = high[k] if b is None else min(high[k], float(b))
        lower.append(low)
        upper.append(high)
    return np.concatenate(lower), np.concatenate(upper)


def _draw(rng: np.random.Generator, lower: Array, upper: Array) -> Array:
    low = np.where(np.isfinite(lower), lower, np.minimum(-_WIDTH, upper - 2 * _WIDTH))
    high = np.where(np.isfinite(upper), upper, np.maximum(_WIDTH, low + 2 * _WIDTH))
    return low + (high - low) * rng.random(low.size)


def _improved(
    start: Array, score: _Score, rng: np.random.Generator, lower: Array, upper: Array
) -> Array:
    """A few random steps uphill, shorter and shorter."""
    best, value = start, score(start)
    for step in _STEPS:
        for _ in range(8):
            moved = best + step * rng.standard_normal(best.size)
            moved = np.clip(moved, lower, upper)
            if (gain := score(moved)) > value:
                best, value = moved, gain
    return best


def _simpler(point: Array, lower: Array, upper: Array) -> Iterator[Array]:
    for denominator in _DENOMINATORS:
        yield np.clip(np.round(point * denominator) / denominator, lower, upper)
    yield point


def _named(claim: Claim, point: Array) -> Point:
    """Exact numbers by variable, moved into the exact domain where they round out."""
    numbers = iter(point.tolist())
    named = {
        symbol.name: [Fraction(next(numbers)) for _ in range(symbol.size)]
        for symbol in claim.variables
    }
    for interval in claim.domain:
        values = named[interval.variable]
        sides = zip(values, interval.lower, interval.upper, strict=True)
        named[interval.variable] = [_clipped(x, low, high) for x, low, high in sides]
    return named


def _clipped(x: Fraction, low: Fraction | None, high: Fraction | None) -> Fraction:
    x = x if low is None else max(x, low)
    return x if high is None else min(x, high)
