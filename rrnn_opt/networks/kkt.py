"""The KKT equations of an equality-constrained programme, and their solve.

Zeroing networks (ZNNs) drive the error of a time-varying equation to zero along
a law of their own.  For ``min 1/2 u'Pu + q'u, A u = b`` the equation is

    error(y) = (P u + q - A' lambda, A u - b) = Phi y - v,   y = (u, lambda),

and the network solves ``Phi y' = wanted - (d error / dp) p'`` in every step: it
is told how the data move (p'), and it needs a linear solve, which is made of
the constant P^-1 and a Cholesky factor of ``A P^-1 A' + damping I``.  The damping
keeps a row that depends on others, or vanishes, from dividing by zero; it slows
the convergence of such a row and does not move the equilibrium.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi as ca

from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks.coefficients import inverse_hessian, is_identity
from rrnn_opt.networks.network import CONSTANT, KKT, NONE, Needs
from rrnn_opt.networks.parts import stacked
from rrnn_opt.networks.whitening import OPERATIONS as FACTORISATION
from rrnn_opt.symbolic.linear import cholesky_solve
from rrnn_opt.symbolic.symbol import Symbol

OPERATIONS = FACTORISATION
"""Tape operations of the solve."""


@dataclass(frozen=True, eq=False)
class Kkt:
    """The equation of one formulation.

    Attributes:
        form: with equality rows only.
        state: y = (u, lambda).
        error: Phi y - v, as long as the state.
        drift: (d error / dp) p', as long as the state.
        rates: p' by the name of p, for every parameter p.
        inverse: P^-1 as constants.
        damping: of the solve.
    """

    form: Formulation
    state: Symbol
    error: ca.SX
    drift: ca.SX
    rates: dict[str, Symbol]
    inverse: ca.SX
    damping: float

    @staticmethod
    def of(form: Formulation, who: str, damping: float) -> Kkt:
        """Set the equation up.

        Args:
            form: with equality rows only and a positive definite Hessian.
            who: the network that asks, for the message.
            damping: of the solve, positive.

        Raises:
            RrnnError: the formulation has bounds or inequality rows, or a
                singular Hessian.
        """
        require_equalities_only(form, who)
        inverse = ca.SX(ca.sparsify(ca.DM(inverse_hessian(form, who))))
        law, qp = form.lagrangian, form.qp
        error = ca.densify(ca.vertcat(law.gradient, qp.A @ form.decision.sx - qp.b))
        rates = {p.name: _rate(p) for p in form.parameters}
        drift = ca.SX.zeros(*error.shape)
        for p in form.parameters:
            drift = drift + ca.jtimes(error, ca.vec(p.sx), ca.vec(rates[p.name].sx))
        state = stacked(law.symbols)
        return Kkt(form, state, error, drift, rates, inverse, damping)

    def solve(self, wanted: ca.SX) -> ca.SX:
        """``Phi^-1 (wanted - drift)``, as long as the state.

        Args:
            wanted: the derivative that the error shall have.
        """
        n, A, M = self.form.decision.size, self.form.qp.A, self.inverse
        top, rest = ca.vertsplit(wanted - self.drift, [0, n, wanted.size1()])
        if rest.size1() == 0:
            return ca.densify(M @ top)
        gram = A @ M @ A.T + self.damping * ca.SX.eye(A.size1())
        dual = cholesky_solve(gram, rest - A @ (M @ top))
        return ca.densify(ca.vertcat(M @ (top + A.T @ dual), dual))

    def common(self) -> dict[str, Any]:
        """Parameters, output, multipliers and rates of the dynamics."""
        law = self.form.lagrangian
        return {
            "parameters": (*self.form.parameters, *self.rates.values()),
            "output": self.form.decision.sx,
            "multipliers": {s.name: s.sx for s in law.symbols[1:]},
            "formulation": self.form,
            "rates": self.rates,
        }


def require_equalities_only(form: Formulation, who: str) -> None:
    """Refuse bounds and inequality rows.

    Raises:
        RrnnError: there are some.
    """
    found = ["bounds on the decision"] if form.qp.bounded else []
    found += ["inequality rows"] if form.inequalities.size1() else []
    if found:
        raise RrnnError(
            f"{who}: {form.name} has {' and '.join(found)}; it solves equations "
            "only: leave them out, or take LviPdnn"
        )


def kkt_needs(form: Formulation, *, extra: int = 0) -> Needs:
    """What a zeroing network needs.

    Args:
        form: the formulation.
        extra: neurons besides y.
    """
    duals = int(form.equalities.size1())
    free = NONE if is_identity(form.qp.hessian) else CONSTANT
    return Needs(
        inverse=KKT if duals else free,
        duals=duals,
        state=form.decision.size + duals + extra,
        definite=True,
        rates=True,
    )


def _rate(symbol: Symbol) -> Symbol:
    """The time derivative of a parameter, as a parameter."""
    name = f"{symbol.name}_rate"
    unit, meaning = f"({symbol.unit})/s", f"time derivative of {symbol.name}"
    return Symbol.matrix(name, symbol.shape, unit, meaning)
