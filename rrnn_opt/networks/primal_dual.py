"""The projected primal-dual network (6)."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from rrnn_opt.dynamics import NeuralDynamics
from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.symbolic.symbol import Symbol


@dataclass(frozen=True)
class PrimalDual:
    """The rule that turns a formulation into the network (6).

        epsilon u'      = -u + P_Omega(u - dL/du)            (6a)
        epsilon lambda' = dL/dlambda = equality rows         (6b)
        epsilon mu'     = -mu + max(mu + g, 0)               (inequality rows; ours)

    that is ``epsilon z' = P_Z(z - F(z)) - z``: its equilibria are the KKT
    points.  A formulation without rows leaves (6a) alone, whose state is u.

    With positive definite P, parameters that stand still, a feasible programme
    and u(0) in Omega, u converges to the optimum for every epsilon (for
    equality rows and bounds).  With P only semidefinite it need not:
    P = 0, J = 1 circles for ever.  If no u in Omega satisfies the rows,
    lambda grows without bound.

    Attributes:
        epsilon: time constant, s.

    Raises:
        RrnnError: epsilon is not positive and finite.

    Source:
        Li, Li, Hannaford (IEEE TII 2019), eq. (6).  The paper has no
        inequality rows besides the box.
    """

    epsilon: float = 0.01

    def __post_init__(self) -> None:
        if not 0.0 < self.epsilon < float("inf"):
            raise RrnnError(f"epsilon {self.epsilon}: it must be positive and finite")

    def __call__(self, form: Formulation) -> NeuralDynamics:
        """The network of ``form``.

        Args:
            form: any formulation.

        Returns:
            Dynamics with state (u, lambda, mu), output u, and the KKT residual
            as equilibrium residual.
        """
        law = form.lagrangian
        multipliers = {s.name: s.sx for s in law.symbols[1:]}
        if form.qp.bounded:
            multipliers["z_box"] = law.bound_dual
        return NeuralDynamics(
            name=f"primal_dual_{form.name}",
            state=_state(law.symbols),
            parameters=form.parameters,
            derivative=law.residual / self.epsilon,
            output=form.decision.sx,
            residual=law.residual,
            multipliers=multipliers,
            formulation=form,
        )


def _state(symbols: tuple[Symbol, ...]) -> Symbol:
    """The decision itself, or (u, lambda, mu) stacked as one symbol."""
    if len(symbols) == 1:
        return symbols[0]
    stacked = ca.vertcat(*(s.sx for s in symbols))
    units = ", ".join(s.unit for s in symbols)
    meaning = "stacked " + ", ".join(s.name for s in symbols)
    return Symbol("state", stacked, units, meaning)
