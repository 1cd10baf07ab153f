"""KKT residuals of a quadratic programme, computed by us.

For min 1/2 x'Px + q'x, A x = b, G x <= h, lb <= x <= ub with multipliers
y, z >= 0 and z_box (positive at an upper, negative at a lower bound) the
conditions are  Px + q + A'y + G'z + z_box = 0, feasibility, and that each
multiplier vanishes where its row is slack.  All residuals are absolute
infinity norms; one that is NaN counts as infinite.  No solver's own word enters.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rrnn_opt.arguments import checked
from rrnn_opt.solving.parts import Array, Dense, Duals, is_usable
from rrnn_opt.solving.status import Status

INACCURATE = 1e3
"""A residual of up to this many tolerances counts as solved inaccurately."""


@dataclass(frozen=True)
class Residual:
    """Absolute KKT residuals; infinite where there was nothing to judge.

    Attributes:
        primal: violation of the rows and bounds.
        dual: stationarity, and multipliers of the wrong sign.
        gap: |primal objective - dual objective|.
        complementarity: largest |multiplier times slack|.
    """

    primal: float
    dual: float
    gap: float
    complementarity: float

    @property
    def worst(self) -> float:
        """The largest of the four."""
        return max(self.primal, self.dual, self.gap, self.complementarity)


NOT_JUDGED = Residual(math.inf, math.inf, math.inf, math.inf)


@checked()
def kkt_residual(problem: Any, x: ArrayLike | None, duals: Duals | None) -> Residual:
    """The four residuals of a point and its multipliers.

    Args:
        problem: ``qpsolvers.Problem`` or ``Dense``.
        x: (n,) point, or None.
        duals: its multipliers, or None (then only the primal one is finite).

    Returns:
        Absolute residuals; all infinite when ``x`` is no usable vector.
    """
    qp = Dense.of(problem)
    if not is_usable(x, qp.q.size):
        return NOT_JUDGED
    point = np.asarray(x, dtype=np.float64)
    primal = _primal(qp, point)
    if duals is None or not _usable_duals(qp, duals):
        return Residual(primal, math.inf, math.inf, math.inf)
    gap = np.abs(point @ (qp.P @ point + qp.q) + dual_support(qp, duals))
    complementarity = _complementarity(qp, point, duals)
    return Residual(primal, _dual(qp, point, duals), _largest(gap), complementarity)


def relative_residual(
    problem: Any, x: ArrayLike | None, duals: Duals | None
) -> Residual:
    """The residuals of ``kkt_residual``, each divided by the size of its terms.

    Primal by 1 + the largest entry of |A x|, |b|, |G x|, |h|; dual by 1 + that of
    |P x|, |q|, |A'y|, |G'z|, |z_box|; gap and complementarity by 1 + |the cost|.

    Args:
        problem: ``qpsolvers.Problem`` or ``Dense``.
        x: (n,) point, or None.
        duals: its multipliers, or None.
    """
    qp, absolute = Dense.of(problem), kkt_residual(problem, x, duals)
    if math.isinf(absolute.dual) or duals is None:
        return absolute
    point = np.asarray(x, dtype=np.float64)
    rows = (qp.A @ point, qp.b, qp.G @ point, qp.h[np.isfinite(qp.h)])
    terms = (qp.P @ point, qp.q, qp.A.T @ duals.y, qp.G.T @ duals.z, duals.z_box)
    primal, dual = (
        1.0 + max(_largest(np.abs(part)) for part in parts) for parts in (rows, terms)
    )
    cost = 1.0 + abs(float(point @ (0.5 * qp.P @ point + qp.q)))
    return Residual(
        absolute.primal / primal,
        absolute.dual / dual,
        absolute.gap / cost,
        absolute.complementarity / cost,
    )


@checked()
def judge(
    problem: Any, x: ArrayLike | None, duals: Duals | None, *, tolerance: float
) -> tuple[Status, Residual]:
    """SOLVED, SOLVED_INACCURATE or NUMERICAL, and the residual that says so.

    Args:
        problem: ``qpsolvers.Problem`` or ``Dense``.
        x: (n,) point, or None.
        duals: its multipliers, or None.
        tolerance: on every one of the four residuals.
    """
    residual = kkt_residual(problem, x, duals)
    if residual.worst <= tolerance:
        return Status.SOLVED, residual
    if residual.worst <= INACCURATE * tolerance:
        return Status.SOLVED_INACCURATE, residual
    return Status.NUMERICAL, residual


def dual_support(qp: Dense, duals: Duals) -> float:
    """The sum b'y + h'z + ub'z_box+ - lb'z_box-, infinite bounds left out.

    What is left out is counted by the dual residual: a multiplier that pushes
    against an infinite bound has the wrong sign.
    """
    up, down = np.maximum(duals.z_box, 0.0), np.maximum(-duals.z_box, 0.0)
    box = np.where(np.isfinite(qp.ub), qp.ub, 0.0) @ up
    box -= np.where(np.isfinite(qp.lb), qp.lb, 0.0) @ down
    rows = np.where(np.isfinite(qp.h), qp.h, 0.0) @ duals.z
    return float(qp.b @ duals.y + rows + box)


def _largest(values: ArrayLike) -> float:
    """The largest of numbers, not below 0; infinite where one is NaN."""
    largest = float(np.max(values, initial=0.0))
    return math.inf if math.isnan(largest) else largest


def _usable_duals(qp: Dense, duals: Duals) -> bool:
    sizes = (len(qp.b), len(qp.h), len(qp.q))
    parts = (duals.y, duals.z, duals.z_box)
    return all(is_usable(v, n) for v, n in zip(parts, sizes, strict=True))


def _primal(qp: Dense, x: Array) -> float:
    return max(
        _largest(np.abs(qp.A @ x - qp.b)),
        _largest(qp.G @ x - qp.h),
        _largest(x - qp.ub),
        _largest(qp.lb - x),
    )


def _dual(qp: Dense, x: Array, duals: Duals) -> float:
    gradient = qp.P @ x + qp.q + qp.A.T @ duals.y + qp.G.T @ duals.z + duals.z_box
    return max(
        _largest(np.abs(gradient)),
        _largest(-duals.z),
        _largest(np.where(np.isinf(qp.h), np.abs(duals.z), 0.0)),
        _largest(np.where(np.isinf(qp.ub), duals.z_box, 0.0)),
        _largest(np.where(np.isinf(qp.lb), -duals.z_box, 0.0)),
    )


def _complementarity(qp: Dense, x: Array, duals: Duals) -> float:
    up, down = np.maximum(duals.z_box, 0.0), np.maximum(-duals.z_box, 0.0)
    slack_up = np.where(np.isfinite(qp.ub), qp.ub - x, 0.0)
    slack_down = np.where(np.isfinite(qp.lb), x - qp.lb, 0.0)
    slack = np.where(np.isfinite(qp.h), qp.h - qp.G @ x, 0.0)
    return max(
        _largest(np.abs(duals.z * slack)),
        _largest(np.abs(up * slack_up)),
        _largest(np.abs(down * slack_down)),
    )
