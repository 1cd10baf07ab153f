"""Short words for what claims have in common, and (3) with its network (6)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

import casadi as ca

from rrnn_opt.claim import Hypothesis, Range, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification.lemmas import clip

Number = Fraction | int | str


def scalars(names: str) -> tuple[Symbol, ...]:
    """Fresh scalars, named in one string."""
    return tuple(Symbol.scalar(name) for name in names.split())


def stated(name: str, text: str, expression: ca.SX, sense: str = ">=0") -> Hypothesis:
    """A hypothesis that the paper makes."""
    return Hypothesis(name, text, Relation(expression, sense))


def added(
    name: str, text: str, expression: ca.SX | None = None, sense: str = ">=0"
) -> Hypothesis:
    """A hypothesis that the paper does not make."""
    relation = None if expression is None else Relation(expression, sense)
    return Hypothesis(name, text, relation, added=True)


def not_negative(*symbols: Symbol) -> tuple[Range, ...]:
    """Symbols whose elements are all at least 0."""
    return tuple(
        Range(s.name, (Fraction(0),) * s.size, (None,) * s.size) for s in symbols
    )


def between(symbol: Symbol, low: Number, high: Number) -> Range:
    """A symbol whose elements all lie in one interval."""
    n = symbol.size
    return Range(symbol.name, (Fraction(low),) * n, (Fraction(high),) * n)


def pinned(symbol: Symbol, values: Sequence[Number]) -> Range:
    """A symbol of known values: data, written exactly."""
    exact = tuple(Fraction(value) for value in values)
    return Range(symbol.name, exact, exact)


def joint_ranges(kinematics: Kinematics, q: Symbol) -> Range:
    """The position limits of a robot, the doubles taken as they are."""
    limits = kinematics.robot.limits

    def exact(bounds: Sequence[float]) -> tuple[Fraction | None, ...]:
        return tuple(Fraction(x) if abs(x) < float("inf") else None for x in bounds)

    return Range(q.name, exact(limits.lower.tolist()), exact(limits.upper.tolist()))


@dataclass(frozen=True, eq=False)
class Programme:
    """(3) and its network (6), every coefficient a variable.

        min u'W u + c'u   s.t.  J u = rd_dot,  low <= u <= high
        epsilon u' = P(u - dL/du) - u,   epsilon lam' = rd_dot - J u

    Attributes:
        u: (n, 1).
        lam: multiplier of (4), (m, 1).
        w: lower triangle of the symmetric W, column by column.
        c: (n, 1).
        J: (m, n).
        rate: rd_dot, (m, 1).
        low: (n, 1).
        high: (n, 1).
    """

    u: Symbol
    lam: Symbol
    w: Symbol
    c: Symbol
    J: Symbol
    rate: Symbol
    low: Symbol
    high: Symbol

    @staticmethod
    def of(n: int, m: int) -> Programme:
        """With n joints and m rows."""
        return Programme(
            Symbol.vector("u", n, "rad/s", "joint velocity"),
            Symbol.vector("lam", m, "1", "multiplier of (4)"),
            Symbol.vector("w", n * (n + 1) // 2, "1", "lower triangle of W"),
            Symbol.vector("c", n),
            Symbol.matrix("J", (m, n), "m/rad", "Jacobian"),
            Symbol.vector("rd_dot", m, "m/s", "desired velocity"),
            Symbol.vector("low", n, "rad/s", "d-"),
            Symbol.vector("high", n, "rad/s", "d+"),
        )

    @property
    def symbols(self) -> tuple[Symbol, ...]:
        """All of them."""
        return (
            self.u,
            self.lam,
            self.w,
            self.c,
            self.J,
            self.rate,
            self.low,
            self.high,
        )

    @property
    def weight(self) -> ca.SX:
        """The symmetric matrix of (3a), (n, n)."""
        n, k = self.u.size, 0
        W = ca.SX.zeros(n, n)
        for j in range(n):
            for i in range(j, n):
                W[i, j] = W[j, i] = self.w.sx[k]
                k += 1
        return W

    def cost(self, u: ca.SX) -> ca.SX:
        """(3a)."""
        return u.T @ self.weight @ u + self.c.sx.T @ u

    def gradient(self, u: ca.SX, lam: ca.SX) -> ca.SX:
        """dL/du of (4): 2 W u + c - J'lam."""
        return 2 * (self.weight @ u) + self.c.sx - self.J.sx.T @ lam

    def rows(self, u: ca.SX) -> ca.SX:
        """rd_dot - J u."""
        return self.rate.sx - self.J.sx @ u

    def projected(self, u: ca.SX, lam: ca.SX) -> ca.SX:
        """P(u - dL/du)."""
        return clip(u - self.gradient(u, lam), self.low.sx, self.high.sx)

    def inside(self, u: ca.SX) -> ca.SX:
        """Not negative where u lies in the box."""
        return ca.vertcat(u - self.low.sx, self.high.sx - u)
