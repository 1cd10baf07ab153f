"""Certificates that a quadratic programme has no feasible point.

By Farkas: if some y and z >= 0 make

    m = min over lb <= x <= ub of (A'y + G'z)'x  -  (b'y + h'z)  >  0,

then no x in the box has A x = b and G x <= h, since for such an x the bracket
is at most zero.  A linear programme proposes (y, z); the minimum over the box
is then evaluated by us, so the proposing solver is not trusted.  It is evaluated
in doubles, and what their rounding may have added is taken off.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rrnn_opt.arguments import checked
from rrnn_opt.errors import ShapeError
from rrnn_opt.solving.parts import Array, Dense

ROUNDING = 1e-12
"""A coefficient below this, relative to the largest entry, counts as zero."""


@dataclass(frozen=True, eq=False)
class Farkas:
    """A witness of infeasibility.

    Attributes:
        y: multipliers of the equalities, (meq,), in [-1, 1].
        z: multipliers of the inequalities, (mineq,), in [0, 1].
        margin: the m above, positive, in the unit of the rows: how far they are
            from being met.
    """

    y: Array
    z: Array
    margin: float


@checked()
def farkas_margin(problem: Any, y: ArrayLike, z: ArrayLike) -> float:
    """The minimum m above for given multipliers, or a little less.

    Args:
        problem: ``qpsolvers.Problem`` or ``Dense``.
        y: (meq,).
        z: (mineq,); negative entries are taken as zero.

    Returns:
        m less a bound on its rounding; -inf when m is unbounded or not a number.

    Raises:
        ShapeError: y or z has another number of rows than the problem.
    """
    qp = Dense.of(problem)
    y, z = np.asarray(y, dtype=np.float64), np.asarray(z, dtype=np.float64)
    for name, given, rows in (("y", y, qp.b), ("z", z, qp.h)):
        if given.shape != rows.shape:
            raise ShapeError(f"farkas_margin: {name}", rows.shape, given.shape)
    z = np.where(np.isfinite(qp.h), np.maximum(z, 0.0), 0.0)
    row = qp.A.T @ y + qp.G.T @ z
    scale = max(np.max(np.abs(qp.A), initial=0.0), np.max(np.abs(qp.G), initial=0.0))
    corner = np.where(row > 0.0, qp.lb, qp.ub)
    row = np.where(np.isinf(corner) & (np.abs(row) <= ROUNDING * scale), 0.0, row)
    if np.isinf(corner[row != 0.0]).any():
        return -np.inf
    corner, h = np.where(row != 0.0, corner, 0.0), np.where(z != 0.0, qp.h, 0.0)
    margin = float(row @ corner - qp.b @ y - h @ z)
    sizes = (np.abs(qp.A).T @ np.abs(y) + np.abs(qp.G).T @ z) @ np.abs(corner)
    sizes += np.abs(qp.b) @ np.abs(y) + np.abs(h) @ z
    terms = len(y) + len(z) + len(row) + 4
    found = margin - float(terms * np.finfo(float).eps * sizes)
    return -np.inf if np.isnan(found) else found


@checked()
def find_farkas(problem: Any, *, tolerance: float = 1e-9) -> Farkas | None:
    """A witness that ``problem`` is infeasible, or None if none was found.

    Args:
        problem: ``qpsolvers.Problem`` or ``Dense``; None is found where a row holds
            NaN or an infinite coefficient.
        tolerance: least margin, with multipliers of at most one, that counts.
    """
    qp = Dense.of(problem)
    if (qp.lb > qp.ub).any():
        zero = np.zeros
        return Farkas(zero(len(qp.b)), zero(len(qp.h)), float(np.max(qp.lb - qp.ub)))
    if not all(np.isfinite(part).all() for part in (qp.A, qp.b, qp.G)):
        return None
    y, z = _propose(qp)
    margin = farkas_margin(qp, y, z)
    return Farkas(y, np.maximum(z, 0.0), margin) if margin > tolerance else None


def _propose(qp: Dense) -> tuple[Array, Array]:
    """Multipliers from the linear programme (HiGHS through scipy).

    Variables (y, z, up, down): min b'y + h'z + ub'up - lb'down subject to
    A'y + G'z + up - down = 0, |y| <= 1 and 0 <= z <= 1.
    """
    from scipy.optimize import linprog

    meq, mineq, n = len(qp.b), len(qp.h), len(qp.q)
    finite = [np.isfinite(v) for v in (qp.h, qp.ub, qp.lb)]
    h, ub, lb = (
        np.where(ok, v, 0.0) for ok, v in zip(finite, (qp.h, qp.ub, qp.lb), strict=True)
    )
    eye: NDArray[np.float64] = np.eye(n)
    bounds: list[tuple[float, float | None]] = [(-1.0, 1.0)] * meq
    bounds += [(0.0, 1.0 if ok else 0.0) for ok in finite[0]]
    bounds += [(0.0, None if ok else 0.0) for part in finite[1:] for ok in part]
    answer = linprog(
        np.concatenate([qp.b, h, ub, -lb]),
        A_eq=np.hstack([qp.A.T, qp.G.T, eye, -eye]),
        b_eq=np.zeros(n),
        bounds=bounds,
        method="highs",
    )
    if answer.x is None:
        return np.zeros(meq), np.zeros(mineq)
    return answer.x[:meq], answer.x[meq : meq + mineq]
