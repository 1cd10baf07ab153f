"""Exact test of positive semidefiniteness, in rational numbers."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike

Row = list[Fraction]


def negative_direction(matrix: ArrayLike) -> tuple[Fraction, ...] | None:
    """A direction of negative curvature, or None when there is none.

    Eliminates symmetrically, ``T P T' = D``, on the doubles taken as the
    rational numbers that they are; no rounding, no tolerance.

    Args:
        matrix: symmetric P, (n, n), finite.

    Returns:
        v with v'Pv < 0; None exactly when P is positive semidefinite.

    Raises:
        ValueError: the matrix is not square, or not symmetric to the last bit.
    """
    numbers = np.asarray(matrix, dtype=np.float64)
    if numbers.ndim != 2 or not np.array_equal(numbers, numbers.T):
        raise ValueError("the matrix must be square and exactly symmetric")
    n = len(numbers)
    rest = [[Fraction(float(x)) for x in line] for line in numbers]
    base = [[Fraction(int(i == j)) for j in range(n)] for i in range(n)]
    for k in range(n):
        pivot = rest[k][k]
        if pivot < 0:
            return tuple(base[k])
        if pivot == 0:
            for j in range(k + 1, n):
                if rest[k][j] != 0:
                    return _mixed(base, rest, k, j)
            continue
        _eliminate(base, rest, k)
    return None


def _eliminate(base: list[Row], rest: list[Row], k: int) -> None:
    """Clear column k below the pivot, keeping ``rest = base P base'``."""
    n = len(rest)
    for i in range(k + 1, n):
        factor = rest[i][k] / rest[k][k]
        if factor == 0:
            continue
        base[i] = [a - factor * b for a, b in zip(base[i], base[k], strict=True)]
        for j in range(k + 1, n):
            rest[i][j] -= factor * rest[k][j]
    for j in range(k + 1, n):
        rest[j][k] = rest[k][j] = Fraction(0)


def _mixed(base: list[Row], rest: list[Row], k: int, j: int) -> tuple[Fraction, ...]:
    """Curvature -1 from a zero pivot with a nonzero entry beside it."""
    weight = -(rest[j][j] + 1) / (2 * rest[k][j])
    return tuple(weight * a + b for a, b in zip(base[k], base[j], strict=True))
