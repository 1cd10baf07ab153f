"""Euler steps that are safe wherever the arm is, whatever is active."""

from __future__ import annotations

import math

import numpy as np

from rrnn_opt.formulation import Formulation
from rrnn_opt.networks import LviPdnn, Network, PrimalDual

_ROUND_DOWN = 1.0 - 1e-9


def longest_step(
    rule: Network, form: Formulation, row_norm: float | None
) -> float | None:
    """A lower bound of ``rule.euler_bound(form, ..)`` over all parameters.

    Whitened equality rows have singular values below one, so with the
    inequality rows bounded by ``row_norm`` the stack B of all rows has
    |B|^2 <= s^2 = 1 + row_norm^2, and with p- <= P <= p+

        LviPdnn:     h <= 2 / (gamma |I + H|^2),
                     |I + H| <= | [[1 + p+, s], [s, 1]] |  (block norms);
                     for P = I the largest singular value of [[2, -s], [s, 1]]
        PrimalDual:  h <= epsilon min(2, 2 / p+, p- / s^2).

    Args:
        rule: the network's rule.
        form: what it was applied to.
        row_norm: upper bound of the norm of the inequality rows; not needed
            when there are none.

    Returns:
        The step, s; None where nothing is known: another network, equality
        rows that are not whitened, or rows without a bound.
    """
    if not isinstance(rule, (LviPdnn, PrimalDual)):
        return None
    if form.equalities.size1() and not rule.whiten:
        return None
    if form.inequalities.size1() and row_norm is None:
        return None
    square = float(form.equalities.size1() > 0)
    if form.inequalities.size1() and row_norm is not None:
        square += row_norm**2
    curvature = np.linalg.eigvalsh(form.qp.hessian)
    if isinstance(rule, LviPdnn):
        size = _size(form, math.sqrt(square), float(curvature[-1]))
        return _ROUND_DOWN * 2.0 / (rule.gamma * size**2)
    swing = float(curvature[0]) / square if square > 0.0 else math.inf
    longest = min(2.0, 2.0 / max(float(curvature[-1]), 1.0), swing)
    return _ROUND_DOWN * rule.epsilon * longest if longest > 0.0 else None


def _size(form: Formulation, s: float, steepest: float) -> float:
    """Upper bound of |I + H|."""
    same = np.array_equal(form.qp.hessian, np.eye(len(form.qp.hessian)))
    block = [[2.0, -s], [s, 1.0]] if same else [[1.0 + steepest, s], [s, 1.0]]
    return max(float(np.linalg.norm(np.array(block), 2)), 1.0 + steepest)
