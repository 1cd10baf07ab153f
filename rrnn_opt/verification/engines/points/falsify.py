"""A seeded search for points that break a claim.

Random starts, each improved by sequential quadratic programming (the goal's
most broken element downhill, hypotheses and domain as constraints).  What it finds
are candidates in floating point.  They prove nothing until the checker has
replayed them.  A breach no larger than rounding is not offered: it speaks of the
constants' last bits.
"""

from __future__ import annotations

import itertools
import time
import warnings
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import numpy as np
from scipy.optimize import minimize

from rrnn_opt.claim import Claim
from rrnn_opt.errors import UndecidedError
from rrnn_opt.verification.document import certificate_document
from rrnn_opt.verification.engines.points.breach import Array, Breach

Point = dict[str, list[Fraction]]

_DENOMINATORS = (1, 4, 12, 64, 1000)
_NOISE = 1e-9  # what floating point may break by rounding alone
_NEAR = 0.05  # a strict goal breaks where it is 0: perhaps at a rounded neighbour
_STEPS = 60
_RANKS = 3  # elements of the goal that are tried from every start, the worst first
_OFFERS = 64


def propose(claim: Claim, *, budget_s: float, seed: int) -> Iterator[dict[str, Any]]:
    """Certificates that ask to replay the candidates.

    Raises:
        UndecidedError: nothing was found, or nothing can be replayed.
    """
    worded = [h.id for h in claim.hypotheses if h.relation is None]
    if worded:
        named = ", ".join(worded)
        raise UndecidedError(f"hypotheses in words only ({named}) cannot be replayed")
    end = time.monotonic() + budget_s
    found = False
    for point in itertools.islice(candidates(claim, seed=seed), _OFFERS):
        found = True
        yield certificate_document(claim, "replay", witness=point)
        if time.monotonic() > end:
            break
    if not found:
        raise UndecidedError("no point found that breaks the goal")


def candidates(
    claim: Claim, *, seed: int = 0, samples: int = 128, starts: int = 10
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
    breach = Breach(claim)
    points = sorted(
        (breach.draw(rng) for _ in range(samples)), key=breach.score, reverse=True
    )
    ranks = range(min(claim.goal.expression.numel(), _RANKS))
    for start in points[:starts]:
        found = (_improved(start, breach, rank=rank) for rank in ranks)
        for best in itertools.chain(found, [start]):
            for point in _simpler(claim, best):
                if breach.score(_column(claim, point)) > _threshold(claim):
                    yield point


def keepers(claim: Claim, *, seed: int = 0, samples: int = 32) -> Iterator[Point]:
    """Points in the domain that keep the hypotheses in floating point."""
    rng = np.random.default_rng(seed)
    breach = Breach(claim)
    for _ in range(samples):
        start = breach.draw(rng)
        found = _first_kept(claim, breach, start)
        if found is None:
            restored = _improved(start, breach)
            found = _first_kept(claim, breach, restored)
        if found is not None:
            yield found


def worth_replaying(claim: Claim, point: Point) -> bool:
    """Whether a point breaks the goal by more than rounding of the constants."""
    return Breach(claim).excess(_column(claim, point)) > _threshold(claim)


def _first_kept(claim: Claim, breach: Breach, start: Array) -> Point | None:
    for point in _simpler(claim, start):
        if breach.keeps(_column(claim, point)):
            return point
    return None


def _threshold(claim: Claim) -> float:
    return -_NEAR if claim.goal.strict else _NOISE


def _improved(start: Array, breach: Breach, *, rank: int | None = None) -> Array:
    """Downhill in one element of the goal, within hypotheses and domain.

    Args:
        start: where to begin.
        breach: the claim.
        rank: 0 for the worst element at the start, 1 for the next, and so on;
            None to leave the goal alone.
    """

    def part(index: int, x: Array) -> Any:
        result = breach.derivatives.call([x])[index]
        return np.nan_to_num(np.asarray(result, dtype=np.float64))

    order = np.argsort(part(0, start).ravel())
    worst = int(order[rank or 0])
    constraints = [
        {
            "type": kind,
            "fun": lambda x, k=index: part(k, x).ravel(),
            "jac": lambda x, k=index: part(k + 3, x),
        }
        for kind, index in (("ineq", 1), ("eq", 2))
        if part(index, start).size
    ]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of values beyond bounds, clipped below
        result = minimize(
            lambda x: float(part(0, x).ravel()[worst]) if rank is not None else 0.0,
            start,
            jac=lambda x: part(3, x)[worst] if rank is not None else np.zeros_like(x),
            bounds=np.column_stack([breach.lower, breach.upper]),
            constraints=constraints,
            method="SLSQP",
            options={"maxiter": _STEPS},
        )
    best = breach.clip(np.asarray(result.x, dtype=np.float64))
    usable = bool(np.all(np.isfinite(best))) and bool(np.all(np.abs(best) < 1e12))
    return best if usable else start


def _simpler(claim: Claim, point: Array) -> Iterator[Point]:
    """The point in simpler and simpler numbers, the simplest first."""
    exact = [Fraction(x) for x in point.tolist()]
    for denominator in _DENOMINATORS:
        yield _named(claim, [x.limit_denominator(denominator) for x in exact])
    yield _named(claim, exact)


def _column(claim: Claim, point: Point) -> Array:
    return np.array([float(x) for s in claim.variables for x in point[s.name]])


def _named(claim: Claim, column: list[Fraction]) -> Point:
    """Numbers by variable, moved into the exact domain where they round out."""
    numbers = iter(column)
    named = {
        symbol.name: [next(numbers) for _ in range(symbol.size)]
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
