"""Small linear algebra written out in SX, for matrices of up to six rows."""

from __future__ import annotations

import casadi as ca

Rows = list[list[ca.SX]]


def cholesky(matrix: ca.SX) -> ca.SX:
    """Lower triangular L with ``L L' = matrix``, unrolled.

    Args:
        matrix: symmetric positive definite, (m, m).

    Returns:
        L, (m, m).  Nothing checks definiteness: add damping first.
    """
    m = matrix.size1()
    factor = ca.SX.zeros(m, m)
    for i, line in enumerate(_factor(matrix)):
        factor[i, : i + 1] = ca.horzcat(*line)
    return factor


def forward_solve(factor: ca.SX, right: ca.SX) -> ca.SX:
    """``L^-1 right`` by forward substitution.

    Args:
        factor: lower triangular L, (m, m).
        right: (m, k).

    Returns:
        (m, k).
    """
    rows: list[ca.SX] = []
    for i in range(factor.size1()):
        s = sum((factor[i, k] * rows[k] for k in range(i)), ca.SX(0))
        rows.append((right[i, :] - s) / factor[i, i])
    return ca.vertcat(*rows)


def backward_solve(factor: ca.SX, right: ca.SX) -> ca.SX:
    """``L'^-1 right`` by backward substitution.

    Args:
        factor: lower triangular L, (m, m).
        right: (m, k).

    Returns:
        (m, k).
    """
    m = factor.size1()
    rows: list[ca.SX] = [ca.SX(0)] * m
    for i in reversed(range(m)):
        s = sum((factor[k, i] * rows[k] for k in range(i + 1, m)), ca.SX(0))
        rows[i] = (right[i, :] - s) / factor[i, i]
    return ca.vertcat(*rows)


def cholesky_solve(matrix: ca.SX, right: ca.SX) -> ca.SX:
    """Solve ``matrix x = right`` by an unrolled Cholesky factorisation.

    Args:
        matrix: symmetric positive definite, (m, m).
        right: (m, 1).

    Returns:
        x, (m, 1).  Nothing checks definiteness: add damping first.
    """
    factor = cholesky(matrix)
    return backward_solve(factor, forward_solve(factor, right))


def _factor(matrix: ca.SX) -> Rows:
    """The rows of L, each up to its diagonal."""
    factor: Rows = []
    for i in range(matrix.size1()):
        line: list[ca.SX] = []
        for j in range(i):
            s = sum((line[k] * factor[j][k] for k in range(j)), ca.SX(0))
            line.append((matrix[i, j] - s) / factor[j][j])
        s = sum((e * e for e in line), ca.SX(0))
        line.append(ca.sqrt(matrix[i, i] - s))
        factor.append(line)
    return factor
