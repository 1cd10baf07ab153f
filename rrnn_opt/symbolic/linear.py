"""Small linear algebra written out in SX, for matrices of up to six rows."""

from __future__ import annotations

import casadi as ca


def cholesky_solve(matrix: ca.SX, right: ca.SX) -> ca.SX:
    """Solve ``matrix x = right`` by an unrolled Cholesky factorisation.

    Args:
        matrix: symmetric positive definite, (m, m).
        right: (m, 1).

    Returns:
        x, (m, 1).  Nothing checks definiteness: add damping first.
    """
    m = matrix.size1()
    factor: list[list[ca.SX]] = []
    for i in range(m):
        line: list[ca.SX] = []
        for j in range(i):
            s = sum((line[k] * factor[j][k] for k in range(j)), ca.SX(0))
            line.append((matrix[i, j] - s) / factor[j][j])
        s = sum((e * e for e in line), ca.SX(0))
        line.append(ca.sqrt(matrix[i, i] - s))
        factor.append(line)
    y: list[ca.SX] = []
    for i in range(m):
        s = sum((factor[i][k] * y[k] for k in range(i)), ca.SX(0))
        y.append((right[i] - s) / factor[i][i])
    x: list[ca.SX] = [ca.SX(0)] * m
    for i in reversed(range(m)):
        s = sum((factor[k][i] * x[k] for k in range(i + 1, m)), ca.SX(0))
        x[i] = (y[i] - s) / factor[i][i]
    return ca.vertcat(*x)
