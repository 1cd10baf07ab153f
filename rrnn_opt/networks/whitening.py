"""Equality rows made orthonormal by a small Cholesky factor.

    A u = b   becomes   L^-1 A u = L^-1 b,   L L' = A A' + delta I

which has the same solutions for every delta > 0, also where A loses rank.  The
singular values sigma of A become sigma / sqrt(sigma^2 + delta): near one, so
that the multipliers settle as fast as the decision.  The multiplier of the
rows as declared is L^-T times that of the whitened ones.

This is a factorisation in every step: no network that carries the paper's name
does it unless it is asked to (Table I: "free of matrix inversion").
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeVar

import casadi as ca

from rrnn_opt.dynamics import DiscreteDynamics, NeuralDynamics
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks.network import CHOLESKY, NONE
from rrnn_opt.symbolic.linear import backward_solve, cholesky, forward_solve

D = TypeVar("D", NeuralDynamics, DiscreteDynamics)

OPERATIONS = frozenset({"add", "sub", "mul", "sq", "sqrt", "div"})
"""Tape operations of the factorisation."""


@dataclass(frozen=True, eq=False)
class Whitened:
    """A formulation with whitened rows, and the way back.

    Attributes:
        original: as declared.
        form: the same with rows ``L^-1 (b - A u)``; the original itself when
            it has no equality rows.
        factor: L, (p, p), of the parameters.
    """

    original: Formulation
    form: Formulation
    factor: ca.SX

    @staticmethod
    def of(form: Formulation, delta: float) -> Whitened:
        """Whiten the equality rows.

        Args:
            form: any formulation.
            delta: added to the squares of A's singular values, positive.
        """
        qp, p = form.qp, form.equalities.size1()
        if p == 0:
            return Whitened(form, form, ca.SX(0, 0))
        factor = cholesky(qp.A @ qp.A.T + delta * ca.SX.eye(p))
        A, b = forward_solve(factor, qp.A), forward_solve(factor, qp.b)
        white = replace(form, equalities=b - A @ form.decision.sx)
        return Whitened(form, white, factor)

    def restore(self, dynamics: D) -> D:
        """Let dynamics made from ``form`` report what was declared."""
        duals = dict(dynamics.multipliers)
        if "lam" in duals:
            duals["lam"] = backward_solve(self.factor, duals["lam"])
        return replace(dynamics, multipliers=duals, formulation=self.original)


def whitened(rule: Callable[[Formulation], D], form: Formulation, delta: float) -> D:
    """The dynamics of a rule over whitened rows, multipliers as declared.

    Args:
        rule: makes dynamics from a formulation.
        form: any formulation; without equality rows nothing changes.
        delta: see ``Whitened.of``.
    """
    white = Whitened.of(form, delta)
    return white.restore(rule(white.form))


def inverse_of(form: Formulation, *, whiten: bool) -> str:
    """What whitening adds to the needs of an inverse-free network."""
    return CHOLESKY if whiten and form.equalities.size1() else NONE
