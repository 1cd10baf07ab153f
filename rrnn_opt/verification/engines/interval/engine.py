"""Engine "interval": branch and bound over the domain of a claim."""

from __future__ import annotations

import os
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import casadi as ca
import numpy as np

from rrnn_opt.check.claims.document import read_claim
from rrnn_opt.check.claims.graph.tree import domain_box
from rrnn_opt.claim import Claim
from rrnn_opt.errors import UndecidedError
from rrnn_opt.verification.document import certificate_document, claim_block
from rrnn_opt.verification.engines.interval.forms import Forms
from rrnn_opt.verification.engines.interval.kernel import Array
from rrnn_opt.verification.engines.interval.search import (
    Budget,
    Outcome,
    Question,
    search,
)
from rrnn_opt.verification.engines.interval.tree import MOST_AXES, packed

SHARE = 0.5
"""Of the time, for the search; the checker needs about as much for the leaves."""


def propose(claim: Claim, *, budget_s: float, seed: int) -> Iterator[dict[str, Any]]:
    """Prove a claim on boxes, or point at where it breaks.

    Args:
        claim: with bounds for every variable; the goal is an inequality.
        budget_s: wall time, s.
        seed: not used: nothing is drawn.

    Yields:
        An "interval" certificate, or a "replay" one.

    Raises:
        UndecidedError: the domain has no bounds, or boxes stay open; the
            reason says how much of the domain, where, and why.
        UnsupportedOperationError: intervals cannot do an operation.
    """
    if claim.goal.sense == "==0":
        raise UndecidedError("boxes do not prove an equation")
    lower, upper = (np.array(x) for x in domain_box(read_claim(claim_block(claim))))
    if len(lower) > MOST_AXES:
        raise UndecidedError(f"more than {MOST_AXES} unknowns")
    outcome = search(question_of(claim), lower, upper, _budget(budget_s))
    if outcome.breach is not None:
        point = _named(claim, outcome.breach)
        yield certificate_document(claim, "replay", witness=point)
    elif outcome.proved:
        payload = packed(outcome.levels)
        yield certificate_document(claim, "interval", payload=payload)
    else:
        raise UndecidedError(_residue(claim, outcome, lower, upper))


def question_of(claim: Claim) -> Question:
    """The claim's relations over one column of unknowns.

    Raises:
        UnsupportedOperationError: intervals cannot do an operation.
    """
    sizes = [symbol.size for symbol in claim.variables]
    x = ca.SX.sym("x", sum(sizes))
    columns = ca.vertsplit(x, [0, *np.cumsum(sizes).tolist()])
    given = [
        ca.reshape(column, *symbol.shape)
        for column, symbol in zip(columns, claim.variables, strict=True)
    ]
    parts = claim.function().call(given)
    senses = [
        relation.sense
        for relation, part in zip(claim.relations, parts, strict=True)
        for _ in range(part.numel())
    ]
    return Question(Forms.of(x, parts), tuple(senses), parts[0].numel())


def _budget(seconds: float) -> Budget:
    return Budget(SHARE * seconds, jobs=os.cpu_count() or 1)


def _named(claim: Claim, point: Array) -> dict[str, list[Fraction]]:
    """The point as exact numbers inside the domain."""
    numbers = iter(point.tolist())
    named = {
        s.name: [Fraction(next(numbers)) for _ in range(s.size)]
        for s in claim.variables
    }
    for interval in claim.domain:
        values = named[interval.variable]
        for k, (low, high) in enumerate(
            zip(interval.lower, interval.upper, strict=True)
        ):
            values[k] = values[k] if low is None else max(values[k], Fraction(low))
            values[k] = values[k] if high is None else min(values[k], Fraction(high))
    return named


def _residue(claim: Claim, outcome: Outcome, lower: Array, upper: Array) -> str:
    """What is left, in one sentence."""
    with np.errstate(invalid="ignore", divide="ignore"):
        widths = (outcome.upper - outcome.lower) / (upper - lower)[:, None]
    share = float(np.sum(np.prod(np.where(np.isfinite(widths), widths, 1.0), axis=0)))
    middle = 0.5 * (outcome.lower[:, 0] + outcome.upper[:, 0])
    where = ", ".join(f"{x:.4g}" for x in middle)
    names = ", ".join(symbol.name for symbol in claim.variables)
    return (
        f"{outcome.lower.shape[1]} of {outcome.boxes} boxes stay open,"
        f" {100 * share:.2g} % of the domain, one of them about ({names}) = ({where});"
        f" {outcome.cause}"
    )
