"""Engine "products": an identity of products, found by a linear programme.

Multiples >= 0 of products of the inequalities, of squares m^2 and (m + n)^2,
(m - n)^2 of monomials, and any multiples of the equations must sum to the goal.
A vertex of the linear programme says which parts take part; their coefficients
are then solved for in rational numbers; where there is no such sum, the cases of a
minimum, maximum, absolute value or comparison are tried one by one.  Sources:
Handelman, Pac. J. Math. 132 (1988) 35-62; Ahmadi and Majumdar, SIAM J. Appl.
Algebra Geometry 3 (2019) 193-230.
"""

from __future__ import annotations

import itertools
import time
from collections.abc import Iterator, Sequence
from typing import Any

from flint import fmpq

from rrnn_opt.check.claims.graph.expansion import Polynomial
from rrnn_opt.check.claims.graph.semialgebraic import Semialgebraic
from rrnn_opt.claim import Claim
from rrnn_opt.errors import UndecidedError
from rrnn_opt.verification.engines.squares.proposal import element_by_element
from rrnn_opt.verification.engines.squares.relaxation import (
    Relaxation,
    generators_of,
    relaxation,
    relevant,
    written,
)
from rrnn_opt.verification.engines.squares.weights import Column, combination

MAX_SQUARES = 24
"""Monomials that enter as squares of sums."""
MAX_DEGREE = 6
MAX_SPLITS = 5
"""Atoms that are taken apart into cases, one inside the other."""


def propose(claim: Claim, *, budget_s: float, seed: int) -> Iterator[dict[str, Any]]:
    """One certificate of all elements, or the reason why there is none.

    Raises:
        UndecidedError: no identity of this form was found.
    """
    yield from element_by_element(claim, _proof, what="products", budget_s=budget_s)


def _proof(
    setting: Semialgebraic, goal: Polynomial, end: float, splits: Sequence[int] = ()
) -> dict[str, Any] | None:
    """An identity, or two cases of an atom with one each, or None."""
    found = _identity(setting, goal, end)
    if found is not None or setting.sense == "==0":
        return found
    split = _next_split(setting, goal, splits)
    if split is None:
        return None
    cases = []
    for case in (0, 1):
        assumed = setting.assuming(split, case)
        part = _proof(assumed, goal, end, (*splits, split))
        if part is None:
            return None  # another order of the atoms is not tried
        cases.append(part)
    return {"split": split, "cases": cases}


def _next_split(
    setting: Semialgebraic, goal: Polynomial, splits: Sequence[int]
) -> int | None:
    """The outermost atom that matters and is not yet split."""
    if len(splits) >= MAX_SPLITS:
        return None
    known = set(relevant(setting, goal))
    atoms = [
        k
        for k, (case, _) in enumerate(setting.splits)
        if k not in splits and generators_of(case[0]) <= known
    ]
    return atoms[-1] if atoms else None


def _identity(
    setting: Semialgebraic, goal: Polynomial, end: float
) -> dict[str, Any] | None:
    target = goal if setting.sense[0] in "=>" else -goal
    first = max(2, target.total_degree())
    if first > MAX_DEGREE:
        raise UndecidedError(f"degree {first} of the goal is too high")
    for degree in range(first, min(first + 2, MAX_DEGREE + 1)):
        left = end - time.monotonic()
        if left <= 0:
            return None
        strict = setting.sense in (">0", "<0")
        parts = relaxation(setting, target, degree, strict=strict)
        columns = _columns(parts, equation=setting.sense == "==0")
        weights = combination(parts.target, columns, left)
        if weights is not None:
            return _written(columns, weights)
    return None


def _columns(parts: Relaxation, *, equation: bool) -> list[Column]:
    equalities = parts.setting.equalities
    columns = [
        Column(parts.reduced(m * equalities[k]), "multiplier", (k,), m)
        for k, m in parts.multipliers
    ]
    if equation:
        return columns
    one = parts.setting.forms.ring.constant(1)
    if parts.strict:
        columns.append(Column(one, "margin", (), one))
    columns += [Column(p, "square", index, one) for index, p in parts.products]
    monomials = parts.monomials(parts.degree // 2)[1:]
    for m in monomials:
        columns.append(Column(parts.reduced(m * m), "square", (), m))
    if len(monomials) < MAX_SQUARES:
        for m, n in itertools.combinations([one, *monomials], 2):
            for base in (m + n, m - n):
                columns.append(Column(parts.reduced(base * base), "square", (), base))
    return columns


def _written(columns: Sequence[Column], weights: dict[int, fmpq]) -> dict[str, Any]:
    proof: dict[str, Any] = {"margin": "0", "squares": [], "multipliers": []}
    for number, weight in sorted(weights.items()):
        column = columns[number]
        if weight == 0:
            continue
        if column.kind == "margin":
            proof["margin"] = str(weight)
        elif column.kind == "square":
            proof["squares"].append(
                {
                    "factors": list(column.index),
                    "basis": [written(column.base)],
                    "gram": [[str(weight)]],
                }
            )
        else:
            term = written(column.base * weight)
            proof["multipliers"].append(
                {"equality": column.index[0], "polynomial": term}
            )
    return proof
