"""Euler steps that are safe wherever the arm is, whatever is active."""

from __future__ import annotations

import math

import numpy as np

from rrnn_opt.formulation import Formulation
from rrnn_opt.networks import LviPdnn, Network

_ROUND_DOWN = 1.0 - 1e-9


def longest_step(
    rule: Network, form: Formulation, row_norm: float | None
) -> float | None:
    """A lower bound of ``rule.euler_bound(form, ..)`` over all parameters.

    Whitened equality rows have singular values below one, so with the
    inequality rows bounded by ``row_norm`` the stack B of all rows has
    |B|^2 <= s^2 = 1 + row_norm^2, and with P <= p+

        h <= 2 / (gamma |I + H|^2),   |I + H| <= | [[1 + p+, s], [s, 1]] |

    by the norms of the blocks; for P = I it is the largest singular value of
    [[2, -s], [s, 1]].  Below it no step goes away from a solution, which is
    known of ``LviPdnn`` alone.

    Args:
        rule: the network's rule.
        form: what it was applied to.
        row_norm: upper bound of the norm of the inequality rows; not needed
            when there are none.

    Returns:
        The step, s; None where nothing is promised: another network, equality
        rows that are not whitened, or rows without a bound.
    """
    if not isinstance(rule, LviPdnn):
        return None
    if form.equalities.size1() and not rule.whiten:
        return None
    if form.inequalities.size1() and row_norm is None:
        return None
    square = float(form.equalities.size1() > 0)
    if form.inequalities.size1() and row_norm is not None:
        square += row_norm**2
    steepest = float(np.linalg.eigvalsh(form.qp.hessian)[-1])
    size = _size(form, math.sqrt(square), steepest)
    return _ROUND_DOWN * 2.0 / (rule.gamma * size**2)


def _size(form: Formulation, s: float, steepest: float) -> float:
    """Upper bound of |I + H|."""
    same = np.array_equal(form.qp.hessian, np.eye(len(form.qp.hessian)))
    block = [[2.0, -s], [s, 1.0]] if same else [[1.0 + steepest, s], [s, 1.0]]
    return max(float(np.linalg.norm(np.array(block), 2)), 1.0 + steepest)
