"""Whether a symmetric matrix of rationals is positive (semi)definite, exactly."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

Rational = Any  # flint.fmpq: python-flint has no usable stubs
Matrix = Sequence[Sequence[Rational]]


def positive(matrix: Matrix, *, definite: bool = False) -> bool:
    """Gaussian elimination (LDL') with exact pivots.

    Args:
        matrix: rows of flint.fmpq; it must be square and symmetric.
        definite: whether a zero pivot is refused too.

    Returns:
        False as well when the matrix is not square or not symmetric.
    """
    size = len(matrix)
    rows = [list(row) for row in matrix]
    if any(len(row) != size for row in rows):
        return False
    if any(rows[i][j] != rows[j][i] for i in range(size) for j in range(i)):
        return False
    for k in range(size):
        pivot = rows[k][k]
        if pivot < 0 or (definite and pivot == 0):
            return False
        if pivot == 0:
            if any(rows[k][j] != 0 for j in range(k + 1, size)):
                return False
            continue
        for i in range(k + 1, size):
            factor = rows[i][k] / pivot
            for j in range(k + 1, i + 1):
                rows[i][j] = rows[j][i] = rows[i][j] - factor * rows[j][k]
    return True
