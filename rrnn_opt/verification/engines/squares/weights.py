"""Exact weights of polynomials that sum to another, by a linear programme."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import fmpq, fmpq_mat
from scipy.optimize import linprog
from scipy.sparse import csc_array

from rrnn_opt.check.claims.graph.expansion import Polynomial
from rrnn_opt.verification.engines.squares.relaxation import (
    sparse,
)

_ZERO = 1e-9


@dataclass(frozen=True)
class Column:
    """One part of the sum.

    Attributes:
        polynomial: what it adds.
        kind: "margin", "square" or "multiplier"; the last may be negative.
        index: factors of a square, number of an equation.
        base: what is squared, or the monomial of a multiplier.
    """

    polynomial: Polynomial
    kind: str
    index: tuple[int, ...]
    base: Polynomial


def combination(
    target: Polynomial, columns: Sequence[Column], wall_s: float
) -> dict[int, fmpq] | None:
    """Exact weights of columns that sum to the target, or None.

    Weights of multipliers have any sign, the others none below zero; the margin
    is positive where there is a column for it.
    """
    rows, matrix, right = _equations(target, columns)
    if not columns or rows is None:
        return {} if target == 0 and not columns else None
    margin = np.array([c.kind == "margin" for c in columns])
    free = np.array([c.kind == "multiplier" for c in columns])
    lower = np.where(free, -np.inf, 0.0)
    upper = np.where(margin, 1.0, np.inf)
    result = linprog(
        np.where(margin, -1.0, np.where(free, 0.0, 1e-3)),
        A_eq=matrix,
        b_eq=right,
        bounds=np.column_stack([lower, upper]),
        method="highs-ds",
        options={"time_limit": max(wall_s, 0.1)},
    )
    if result.x is None or result.status != 0:
        return None
    support = [int(k) for k in np.flatnonzero(np.abs(result.x) > _ZERO)]
    weights = _solved(target, columns, support)
    if weights is None:
        return None
    good = all(free[k] or w >= 0 for k, w in weights.items())
    positive = not margin.any() or any(margin[k] and w > 0 for k, w in weights.items())
    return weights if good and positive else None


def _equations(target: Polynomial, columns: Sequence[Column]) -> tuple[Any, Any, Any]:
    number: dict[Any, int] = {}
    entries = [sparse(c.polynomial) for c in columns]
    for entry in entries:
        for monomial in entry:
            number.setdefault(monomial, len(number))
    wanted = sparse(target)
    if not wanted.keys() <= number.keys():
        return None, None, None
    data = [float(x.p) / float(x.q) for entry in entries for x in entry.values()]
    row = [number[m] for entry in entries for m in entry]
    column = [k for k, entry in enumerate(entries) for _ in entry]
    right = np.zeros(len(number))
    for monomial, x in wanted.items():
        right[number[monomial]] = float(x.p) / float(x.q)
    shape = (len(number), len(columns))
    return number, csc_array((data, (row, column)), shape=shape), right


def _solved(
    target: Polynomial, columns: Sequence[Column], support: Sequence[int]
) -> dict[int, fmpq] | None:
    """The weights on the support, in rational numbers."""
    entries = [sparse(columns[k].polynomial) for k in support] + [sparse(target)]
    monomials = list(dict.fromkeys(m for entry in entries for m in entry))
    zero = fmpq(0)
    table = [[entry.get(m, zero) for entry in entries] for m in monomials]
    if not table:
        return {}
    reduced, rank = fmpq_mat(table).rref()
    weights: dict[int, fmpq] = {}
    for r in range(rank):
        pivot = next(k for k in range(len(entries)) if reduced[r, k] != 0)
        if pivot == len(support):
            return None  # the support does not suffice
        weights[support[pivot]] = reduced[r, len(support)]
    return weights
