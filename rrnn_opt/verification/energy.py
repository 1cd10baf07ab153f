"""The energy of the network (6) over data that stand still."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification.composite import Given, Instance, Proof
from rrnn_opt.verification.lemmas import projection
from rrnn_opt.verification.vocabulary import Programme, added, stated

RULES = (
    "Danskin: the gradient of max_y F'(z - y) - |z - y|^2/2 is F + (dF/dz)'(z - y) "
    "- (z - y)",
    "LaSalle: V has compact level sets, and V' = 0 only where u is the optimum",
)


@dataclass(frozen=True, eq=False)
class Frozen:
    """(6) with a rest point z* = (u*, lam*), in the time unit epsilon.

        z' = d = P(z - F(z)) - z,   F = (2 W u + c - J'lam, J u - rd_dot)
        V  = -F'd - |d|^2/2 + |z - z*|^2/2
        V' = F'd - d'(dF/dz)d + |d|^2 + (z - z*)'d

    (dF/dz)d = (2 W d_u - J'd_lam, J d_u), so d'(dF/dz)d = 2 d_u'W d_u.

    Attributes:
        p: programme and state.
        u: rest point u*, an optimum of (3).
        lam: its multiplier.
    """

    p: Programme
    u: Symbol
    lam: Symbol

    @staticmethod
    def of(n: int, m: int) -> Frozen:
        """With n joints and m rows."""
        return Frozen(
            Programme.of(n, m),
            Symbol.vector("u_star", n, "rad/s", "optimum of (3)"),
            Symbol.vector("lam_star", m, "1", "its multiplier"),
        )

    @property
    def symbols(self) -> tuple[Symbol, ...]:
        """All variables."""
        return (*self.p.symbols, self.u, self.lam)

    @property
    def drift(self) -> ca.SX:
        """d_u = P(u - dL/du) - u."""
        return self.p.projected(self.p.u.sx, self.p.lam.sx) - self.p.u.sx

    @property
    def margins(self) -> ca.SX:
        """Two numbers that are not negative: see the claim."""
        p, u, lam = self.p, self.p.u.sx, self.p.lam.sx
        g, r, d = p.gradient(u, lam), p.rows(u), self.drift
        away, apart = u - self.u.sx, lam - self.lam.sx
        # F = (g, -r) and d = (d, r)
        Fd = ca.dot(g, d) - ca.dot(r, r)
        size = ca.dot(d, d) + ca.dot(r, r)
        bend = 2 * d.T @ p.weight @ d
        rate = Fd - bend + size + ca.dot(away, d) + ca.dot(apart, r)
        decrease = -rate - bend - 2 * away.T @ p.weight @ away
        gap = -Fd - size  # V - |z - z*|^2/2 - |d|^2/2
        return ca.vertcat(decrease, gap)

    def claim(
        self, name: str, statement: str, goal: ca.SX, *, inside: bool = True
    ) -> Claim:
        """The claim that the margins are not negative.

        Args:
            name: id.
            statement: in words.
            goal: the margins.
            inside: whether u(0) is assumed to lie in the box.
        """
        p = self.p
        rest = p.projected(self.u.sx, self.lam.sx) - self.u.sx
        hypotheses = [
            stated("H1", "u* solves (5)", rest, "==0"),
            stated("H2", "J u* = rd_dot", p.rows(self.u.sx), "==0"),
            stated("H3", "u* lies in Omega", p.inside(self.u.sx)),
            added("A1", "W is positive definite"),
            added("A2", "J, rd_dot, c and Omega stand still, (3) is feasible"),
        ]
        if inside:
            hypotheses.append(
                added("A3", "u(0) lies in Omega, so u does", p.inside(p.u.sx))
            )
        return Claim(
            id=name,
            source="eq. (6)",
            statement=statement,
            variables=self.symbols,
            goal=Relation(goal, ">=0"),
            hypotheses=tuple(hypotheses),
            order="second-order",
            jacobian="frozen",
        )

    def decrease_terms(self) -> tuple[Instance | Given, ...]:
        """The projection at z against u*, and at u* against u."""
        p, u, us = self.p, self.p.u.sx, self.u.sx
        drive = u - p.gradient(u, p.lam.sx)
        rest = us - p.gradient(us, self.lam.sx)
        now = p.projected(u, p.lam.sx)
        terms: list[Instance | Given] = []
        for i in range(p.u.size):
            box = {"low": p.low.sx[i], "high": p.high.sx[i]}
            terms.append(Instance(0, box | {"x": drive[i], "s": now[i], "y": us[i]}))
            terms.append(Instance(0, box | {"x": rest[i], "s": us[i], "y": u[i]}))
        apart = p.lam.sx - self.lam.sx
        return (*terms, *(Given(1, k, -apart[k]) for k in range(p.lam.size)))

    def bound_terms(self) -> tuple[Instance, ...]:
        """The projection at z against z itself."""
        p, u = self.p, self.p.u.sx
        drive, now = u - p.gradient(u, p.lam.sx), p.projected(u, p.lam.sx)
        return tuple(
            Instance(
                0,
                {
                    "x": drive[i],
                    "s": now[i],
                    "y": u[i],
                    "low": p.low.sx[i],
                    "high": p.high.sx[i],
                },
            )
            for i in range(p.u.size)
        )

    def example(self) -> dict[str, list[int]]:
        """A point that keeps the hypotheses: everything at rest at zero."""
        n, m = self.p.u.size, self.p.lam.size
        point = {s.name: [0] * s.size for s in self.symbols}
        box = {"low": [-1] * n, "high": [1] * n}
        return point | box | {"u_star": [0] * n, "lam_star": [0] * m}


def decrease(frozen: Frozen, name: str) -> Proof:
    """The energy of (6) decreases, and bounds the distance to the optimum."""
    statement = "(6) with W > 0 and frozen, feasible data settles at the optimum of (3)"
    claim = frozen.claim(name, statement, frozen.margins)
    terms = (frozen.decrease_terms(), frozen.bound_terms())
    return Proof(claim, (projection(),), terms, RULES, frozen.example())
