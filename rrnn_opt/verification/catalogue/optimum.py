"""A rest point of a network is an optimum of its formulation."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import casadi as ca
import numpy as np

from rrnn_opt.claim import Claim, Hypothesis, Relation
from rrnn_opt.errors import UndecidedError
from rrnn_opt.formulation import Formulation
from rrnn_opt.symbolic import Box, Symbol
from rrnn_opt.verification.composite import Given, Instance, Proof, Term
from rrnn_opt.verification.document import Witness
from rrnn_opt.verification.engines.points.rationals import exact_values
from rrnn_opt.verification.lemmas import complementary, projection


def equilibrium_is_optimum(form: Formulation) -> Proof | None:
    """Where the residual of (5) is zero, no feasible y is cheaper.

        f(y) - f(u) - (y - u)'P(y - u)/2 = g'(y - u) + lam'A(y - u) - mu'G(y - u)

    for g = dL/du; each term of the first sum is the scalar lemma of the
    projection, the second vanishes as both satisfy the rows, and each term of
    the third is the lemma of complementary pairs.  P is positive semidefinite by
    the declaration of a formulation.  Where I - P is not exact in doubles the
    claim is of (5), and not of the last bits of the network that folds it.

    Args:
        form: any formulation whose bounds are on both sides or on none.

    Returns:
        The proof, over the very graph of the formulation; None where a bound
        is on one side only.
    """
    parts = _Parts.of(form)
    if parts is None:
        return None
    u, y, P = form.decision.sx, parts.y.sx, ca.SX(form.qp.P)
    gap = y - u
    other = ca.substitute(form.cost, u, y)
    margin = other - form.cost - gap.T @ P @ gap / 2
    claim = Claim(
        id="equilibrium_is_optimum",
        source="eq. (5)",
        statement=f"a rest point of the network of {form.name} is an optimum",
        variables=(*form.lagrangian.symbols, *form.parameters, parts.y),
        goal=Relation(margin, ">=0"),
        hypotheses=parts.hypotheses,
        jacobian="frozen",
    )
    lemmas = (projection(), complementary())
    return Proof(claim, lemmas, (parts.terms,), (), _rest_at_zero(form))


RATES = ("rd_dot", "rd_ddot")
"""Parameters that the equality rows hold with factor 1."""


def _rest_at_zero(form: Formulation) -> Witness | None:
    """A rest point in rational numbers, at q = 0, with zero multipliers.

    u = P(-q) for the linear part q of the cost, the desired rate is what u
    gives, and clearances are ten metres; None where that is no rest point.
    """
    point = {p.name: [Fraction(0)] * p.size for p in form.parameters}
    if "clearances" in point:
        point["clearances"] = [Fraction(10)] * len(point["clearances"])
    names = [p.name for p in form.parameters]
    inputs, qp = [p.sx for p in form.parameters], form.qp
    start = ca.Function("u", inputs, [Box(qp.lb, qp.ub).project(-qp.q)], names, ["u"])
    rows = ca.Function(
        "rows", [form.decision.sx, *inputs], [form.equalities], ["u", *names], ["rows"]
    )
    try:
        (u,) = exact_values(start, point)
        (left,) = exact_values(rows, point | {"u": u})
    except UndecidedError:
        return None
    for name in RATES:
        if len(point.get(name, ())) == len(left) > 0:
            point[name] = [-x for x in left]
    duals = {s.name: [Fraction(0)] * s.size for s in form.lagrangian.symbols[1:]}
    return point | duals | {form.decision.name: u, "y": u}


@dataclass(frozen=True, eq=False)
class _Parts:
    """What the proof says of a formulation."""

    form: Formulation
    y: Symbol
    bounded: tuple[bool, ...]

    @staticmethod
    def of(form: Formulation) -> _Parts | None:
        sides = zip(ca.vertsplit(form.qp.lb), ca.vertsplit(form.qp.ub), strict=True)
        both = [(_finite(low), _finite(high)) for low, high in sides]
        if any(low != high for low, high in both):
            return None
        y = Symbol.vector("y", form.decision.size, form.decision.unit, "feasible")
        return _Parts(form, y, tuple(low for low, _ in both))

    @property
    def drive(self) -> ca.SX:
        """The point u - dL/du: the graph's own, I - P folded, where that is exact."""
        law, P = self.form.lagrangian, self.form.qp.hessian
        folded = np.eye(len(P)) - P
        exact = all(
            Fraction(float(f)) == int(i == j) - Fraction(float(P[i, j]))
            for (i, j), f in np.ndenumerate(folded)
        )
        return law.drive if exact else self.form.decision.sx - law.gradient

    @property
    def residual(self) -> list[ca.SX]:
        """Of (5): for u, for the equality rows, for the inequality rows."""
        qp, law, u = self.form.qp, self.form.lagrangian, self.form.decision.sx
        n, p, m = qp.P.size1(), qp.b.size1(), qp.h.size1()
        _, rows, pairs = ca.vertsplit(law.residual, [0, n, n + p, n + p + m])
        moved = ca.SX(Box(qp.lb, qp.ub).project(self.drive))
        return [moved - u, rows, pairs]

    @property
    def hypotheses(self) -> tuple[Hypothesis, ...]:
        """The residual is zero, and y is feasible; absent parts are left out."""
        qp, y = self.form.qp, self.y.sx
        rest, rows, pairs = self.residual
        inside = [
            side
            for i, bounded in enumerate(self.bounded)
            if bounded
            for side in (y[i] - qp.lb[i], qp.ub[i] - y[i])
        ]
        named = (
            ("H1", "u is at rest", rest, "==0"),
            ("H2", "the rows hold at u", rows, "==0"),
            ("H3", "mu is at rest", pairs, "==0"),
            ("H4", "the rows hold at y", qp.b - qp.A @ y, "==0"),
            ("H5", "the inequality rows hold at y", qp.h - qp.G @ y, ">=0"),
            ("H6", "y lies in the box", ca.vertcat(*inside), ">=0"),
        )
        return tuple(
            Hypothesis(name, text, Relation(ca.densify(expression), sense))
            for name, text, expression, sense in named
            if expression.numel()
        )

    @property
    def terms(self) -> tuple[Term, ...]:
        """Of the sum in the docstring of the claim."""
        qp, law, y = self.form.qp, self.form.lagrangian, self.y.sx
        place = {h.id: k for k, h in enumerate(self.hypotheses)}
        u, drive = self.form.decision.sx, self.drive
        found: list[Term] = []
        for i, bounded in enumerate(self.bounded):
            if not bounded:
                found.append(Given(place["H1"], i, u[i] - y[i]))
                continue
            box = {"low": qp.lb[i], "high": qp.ub[i]}
            found.append(Instance(0, box | {"x": drive[i], "s": u[i], "y": y[i]}))
        if law.equality_dual is not None:
            for k, lam in enumerate(ca.vertsplit(law.equality_dual.sx)):
                found += [Given(place["H2"], k, lam), Given(place["H4"], k, -lam)]
        if law.inequality_dual is not None:
            slack, room = qp.G @ u - qp.h, qp.h - qp.G @ y
            for k, mu in enumerate(ca.vertsplit(law.inequality_dual.sx)):
                found.append(Instance(1, {"mu": mu, "g": slack[k], "t": room[k]}))
        return tuple(found)


def _finite(bound: ca.SX) -> bool:
    return not (bound.is_constant() and abs(float(bound)) == np.inf)
