"""Kernels of floating-point matrices, written in small rational numbers."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from flint import fmpq, fmpq_mat
from numpy.typing import NDArray

Array = NDArray[np.float64]
_NOTHING = 1e-4  # eigenvalues below this share of the largest count as 0
_SIZE = 32  # largest denominator of a kernel's entries
_MISS = 2e-4


def complement(gram: Array) -> list[list[fmpq]] | None:
    """A rational basis of what a matrix's kernel leaves, row by row.

    Args:
        gram: symmetric, (n, n), without negative eigenvalues but for noise.

    Returns:
        Rows orthogonal to the kernel; None where it is 0 or not rational.
    """
    size = len(gram)
    values, vectors = np.linalg.eigh(gram)
    flat = values < _NOTHING * max(1.0, values[-1] if size else 0.0)
    if not flat.any():
        return None
    kernel = _echelon(vectors[:, flat].T)
    exact = [[Fraction(x).limit_denominator(_SIZE) for x in row] for row in kernel]
    near = np.array([[float(x) for x in row] for row in exact])
    if np.max(np.abs(near - kernel)) > _MISS:
        return None
    if len(exact) == size:
        return []
    rows = [[fmpq(x.numerator, x.denominator) for x in row] for row in exact]
    return _orthogonal(rows, size)


def _echelon(rows: Array) -> Array:
    """Reduced row echelon form, the largest pivot of each row first."""
    rows = rows.copy()
    for k in range(len(rows)):
        column = int(np.argmax(np.abs(rows[k])))
        rows[k] /= rows[k, column]
        for other in range(len(rows)):
            if other != k:
                rows[other] -= rows[other, column] * rows[k]
    return rows


def _orthogonal(rows: list[list[fmpq]], size: int) -> list[list[fmpq]]:
    """A basis of all vectors orthogonal to the rows."""
    reduced, rank = fmpq_mat(rows).rref()
    pivots = [next(k for k in range(size) if reduced[r, k] != 0) for r in range(rank)]
    basis = []
    for free in (k for k in range(size) if k not in pivots):
        vector = [fmpq(0)] * size
        vector[free] = fmpq(1)
        for r, pivot in enumerate(pivots):
            vector[pivot] = -reduced[r, free]
        basis.append(vector)
    return basis
