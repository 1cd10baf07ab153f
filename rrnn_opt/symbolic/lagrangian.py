"""Lagrangian, KKT residual and monotone map of a declared programme."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from rrnn_opt.symbolic.convex_set import ConvexSet
from rrnn_opt.symbolic.qp import QP
from rrnn_opt.symbolic.sets import Box, Orthant, Product, whole_space
from rrnn_opt.symbolic.symbol import Symbol, require_names


@dataclass(frozen=True, eq=False)
class Lagrangian:
    """``L(u, lambda, mu) = cost + lambda'e(u) + mu'g(u)``, rows as declared.

    With the row ``e = rd_dot - J u`` this is (4).  The bounds on u stay a set
    Omega; with z = (u, lambda, mu), Z = Omega x R^p x R^m_+ and the monotone
    map ``F(z) = (dL/du, -dL/dlambda, -dL/dmu)``, a point is a KKT point exactly
    when ``P_Z(z - F(z)) = z``, which is (5) with inequalities added.

    Attributes:
        qp: the standard form.
        equality_dual: lambda, "lam", (p, 1); None without equalities.
        inequality_dual: mu, "mu", (m, 1); None without inequalities.
        expression: L, (1, 1).
        gradient: dL/du, (n, 1).

    Source:
        Li, Li, Hannaford (IEEE TII 2019), eqs. (4), (5).  Inequality rows and
        their multiplier mu are ours.
    """

    qp: QP
    equality_dual: Symbol | None
    inequality_dual: Symbol | None
    expression: ca.SX
    gradient: ca.SX

    @staticmethod
    def of(
        qp: QP, *, cost: ca.SX, equalities: ca.SX, inequalities: ca.SX
    ) -> Lagrangian:
        """The Lagrangian of a declaration and its standard form.

        Args:
            qp: standard form of the same declaration.
            cost: (1, 1).
            equalities: e, (p, 1).
            inequalities: g, (m, 1).

        Raises:
            RrnnError: a parameter is called "lam" or "mu".
        """
        lam = _dual("lam", equalities, "multiplier of the equality rows")
        mu = _dual("mu", inequalities, "multiplier of the inequality rows, >= 0")
        value = cost
        gradient = qp.P @ qp.decision.sx + qp.q
        if lam is not None:
            value = value + ca.dot(lam.sx, equalities)
            gradient = gradient - qp.A.T @ lam.sx
        if mu is not None:
            value = value + ca.dot(mu.sx, inequalities)
            gradient = gradient + qp.G.T @ mu.sx
        own = tuple(s for s in (qp.decision, lam, mu) if s is not None)
        require_names((*own, *qp.parameters), "Lagrangian")
        return Lagrangian(qp, lam, mu, value, ca.densify(gradient))

    @property
    def symbols(self) -> tuple[Symbol, ...]:
        """u, then lambda and mu where there are rows for them."""
        every = (self.qp.decision, self.equality_dual, self.inequality_dual)
        return tuple(s for s in every if s is not None)

    @property
    def point(self) -> ca.SX:
        """The stacked z = (u, lambda, mu), (n + p + m, 1)."""
        return ca.vertcat(*(s.sx for s in self.symbols))

    @property
    def set(self) -> Product:
        """Z = Omega x R^p x R^m_+."""
        factors: list[ConvexSet] = [Box(self.qp.lb, self.qp.ub)]
        if self.equality_dual is not None:
            factors.append(whole_space(self.equality_dual.size))
        if self.inequality_dual is not None:
            factors.append(Orthant(self.inequality_dual.size))
        return Product(tuple(factors))

    @property
    def map(self) -> ca.SX:
        """F(z) = (dL/du, -e, -g), (n + p + m, 1): monotone, as P is semidefinite."""
        u, qp = self.qp.decision.sx, self.qp
        parts = [self.gradient]
        if self.equality_dual is not None:
            parts.append(qp.A @ u - qp.b)
        if self.inequality_dual is not None:
            parts.append(qp.h - qp.G @ u)
        return ca.vertcat(*parts)

    @property
    def drive(self) -> ca.SX:
        """``u - dL/du``, (n, 1), written with the constant I - P folded.

        P = I therefore leaves exactly ``A'lambda - G'mu - q``: no ``u - u``
        remains in the graph, neither as work nor as rounding.
        """
        identity = ca.DM.eye(self.qp.decision.size)
        rest = ca.SX(ca.sparsify(identity - ca.DM(self.qp.hessian)))
        drive = rest @ self.qp.decision.sx - self.qp.q
        if self.equality_dual is not None:
            drive = drive + self.qp.A.T @ self.equality_dual.sx
        if self.inequality_dual is not None:
            drive = drive - self.qp.G.T @ self.inequality_dual.sx
        return ca.densify(drive)

    @property
    def residual(self) -> ca.SX:
        """``P_Z(z - F(z)) - z``, (n + p + m, 1), zero exactly at the KKT points.

        Its parts are ``P_Omega(u - dL/du) - u``, e, and ``max(mu + g, 0) - mu``.
        """
        u, qp = self.qp.decision.sx, self.qp
        parts = [Box(qp.lb, qp.ub).project(self.drive) - u]
        if self.equality_dual is not None:
            parts.append(qp.b - qp.A @ u)
        if self.inequality_dual is not None:
            mu = self.inequality_dual.sx
            parts.append(ca.fmax(mu + (qp.G @ u - qp.h), 0) - mu)
        return ca.vertcat(*parts)

    @property
    def bound_dual(self) -> ca.SX:
        """``-dL/du``, (n, 1): at a KKT point the ``z_box`` of qpsolvers."""
        return -self.gradient


def _dual(name: str, rows: ca.SX, meaning: str) -> Symbol | None:
    count = int(rows.size1())
    return Symbol.vector(name, count, "1", meaning) if count else None
