"""Euler steps that are safe wherever the arm is, whatever is active."""

from __future__ import annotations

import math

import numpy as np

from rrnn_opt.embedding.step_claim import SafeStep
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks import LviPdnn, Network

_ROUND_DOWN = 1.0 - 1e-6
"""Room for the rounding of the constant, also to single precision."""


def longest_step(
    rule: Network, form: Formulation, row_norm: float | None
) -> float | None:
    """A lower bound of ``rule.euler_bound(form, ..)`` over all parameters.

    Whitened equality rows have singular values below one, so with the
    inequality rows bounded by ``row_norm`` the stack B of all rows has
    |B|^2 <= s^2 = 1 + row_norm^2, and with P <= p+

        h <= 2 / (gamma |I + H|^2),   |I + H| <= | [[1 + p+, s], [s, 1]] |

    by the norms of the blocks; for P = I it is the step that ``SafeStep``
    proves.  Below it no step goes away from a solution, which is known of
    ``LviPdnn`` alone.

    Args:
        rule: the network's rule.
        form: what it was applied to.
        row_norm: upper bound of the norm of the inequality rows; not needed
            when there are none.

    Returns:
        The step, s; None where nothing is promised: another network, equality
        rows that are not whitened, or rows without a bound.
    """
    square = _square(rule, form, row_norm)
    if square is None or not isinstance(rule, LviPdnn):
        return None
    safe = safe_step(rule, form, row_norm)
    if safe is not None:
        return _ROUND_DOWN * float(safe.tau) / rule.gamma
    steepest, s = float(np.linalg.eigvalsh(form.qp.hessian)[-1]), math.sqrt(square)
    size = float(np.linalg.norm(np.array([[1.0 + steepest, s], [s, 1.0]]), 2))
    return _ROUND_DOWN * 2.0 / (rule.gamma * size**2)


def safe_step(
    rule: Network, form: Formulation, row_norm: float | None
) -> SafeStep | None:
    """The claim behind the step; None where there is none, or P is not I.

    Args:
        rule: the network's rule.
        form: what it was applied to.
        row_norm: upper bound of the norm of the inequality rows.
    """
    square = _square(rule, form, row_norm)
    P = form.qp.hessian
    if square is None or square == 0.0 or not np.array_equal(P, np.eye(len(P))):
        return None
    rows = int(form.equalities.size1() + form.inequalities.size1())
    return SafeStep.of(len(P), rows, square)


def _square(rule: Network, form: Formulation, row_norm: float | None) -> float | None:
    """Upper bound of |B|^2; None where there is none."""
    if not isinstance(rule, LviPdnn):
        return None
    if form.equalities.size1() and not rule.whiten:
        return None
    if form.inequalities.size1() == 0:
        return float(form.equalities.size1() > 0)
    if row_norm is None:
        return None
    return float(form.equalities.size1() > 0) + row_norm**2
