"""What networks in the multipliers alone share."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import casadi as ca

from rrnn_opt.formulation import Formulation
from rrnn_opt.networks.coefficients import inverse_hessian, is_identity
from rrnn_opt.networks.network import CHOLESKY, CONSTANT, NONE, Needs, rows
from rrnn_opt.networks.parts import stacked
from rrnn_opt.networks.projection import ProjectionNetwork
from rrnn_opt.networks.whitening import D
from rrnn_opt.symbolic.sets import Box
from rrnn_opt.symbolic.symbol import Symbol


@dataclass(frozen=True, eq=False)
class DualParts:
    """The dual of ``min 1/2 x'Px + q'x, A x = b, G x <= h, lb <= x <= ub``.

    Attributes:
        form: the formulation.
        inverse: M = P^-1 as constants, (n, n).
        symbols: lambda, mu and z_box, those that there are.
        primal: x = M (A' lambda - G' mu - z_box - q), (n, 1): where the
            Lagrangian is least.
        residual: zero exactly at the optimal multipliers.
    """

    form: Formulation
    inverse: ca.SX
    symbols: tuple[Symbol, ...]
    primal: ca.SX
    residual: ca.SX

    @staticmethod
    def of(form: Formulation, who: str) -> DualParts:
        """Take a formulation to its dual; without rows and bounds z_box stays.

        Args:
            form: with a positive definite Hessian.
            who: the network that asks, for the message.

        Raises:
            RrnnError: the Hessian is singular.
        """
        inverse = ca.SX(ca.sparsify(ca.DM(inverse_hessian(form, who))))
        law, qp = form.lagrangian, form.qp
        pull, symbols = -qp.q, list(law.symbols[1:])
        if law.equality_dual is not None:
            pull = pull + qp.A.T @ law.equality_dual.sx
        if law.inequality_dual is not None:
            pull = pull - qp.G.T @ law.inequality_dual.sx
        if qp.bounded or not symbols:
            n = form.decision.size
            symbols.append(Symbol.vector("z_box", n, "1", "multiplier of the bounds"))
            pull = pull - symbols[-1].sx
        primal = ca.densify(inverse @ pull)
        return DualParts(
            form, inverse, tuple(symbols), primal, _residual(form, symbols, primal)
        )

    def common(self) -> dict[str, Any]:
        """All of the dynamics but name and law; a run starts at zero."""
        return {
            "state": stacked(self.symbols),
            "parameters": self.form.parameters,
            "output": self.primal,
            "residual": self.residual,
            "multipliers": self._multipliers(),
            "formulation": self.form,
        }

    def _multipliers(self) -> dict[str, ca.SX]:
        named = {s.name: s.sx for s in self.symbols}
        if not self.form.qp.bounded:
            named.pop("z_box", None)
        return named


def _residual(form: Formulation, symbols: list[Symbol], x: ca.SX) -> ca.SX:
    """``(b - A x, max(mu + G x - h, 0) - mu, x - P_Omega(x + z))``."""
    qp, parts = form.qp, []
    for symbol in symbols:
        if symbol.name == "lam":
            parts.append(qp.b - qp.A @ x)
        elif symbol.name == "mu":
            parts.append(ca.fmax(symbol.sx + (qp.G @ x - qp.h), 0) - symbol.sx)
        else:
            parts.append(x - Box(qp.lb, qp.ub).project(x + symbol.sx))
    return ca.vertcat(*parts)


@dataclass(frozen=True, kw_only=True)
class DualProjection(ProjectionNetwork[D]):
    """A projection network whose neurons are the multipliers alone."""

    definite = True

    def needs(self, form: Formulation) -> Needs:
        """P^-1, constant, unless P is I; the factor of whitening; a neuron a row."""
        inverses = [] if is_identity(form.qp.hessian) else [CONSTANT]
        if self.whiten and form.equalities.size1():
            inverses.append(CHOLESKY)
        size = rows(form)
        size += form.decision.size if form.qp.bounded or not size else 0
        needed = " and ".join(inverses) or NONE
        return Needs(needed, duals=size, state=size, definite=self.definite)
