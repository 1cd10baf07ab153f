"""The first-order law (18) with every coefficient a variable."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification.lemmas import clip


@dataclass(frozen=True, eq=False)
class Reduced:
    """``q' = P(J's)``, s = e/epsilon, on a box; V = |e|^2/2.

    V' = -e'J P(J's) = -epsilon x'P(x) with x = J's; epsilon > 0 is left out.

    Attributes:
        J: (m, n).
        s: error over epsilon, (m, 1).
        low: (n, 1).
        high: (n, 1).
    """

    J: Symbol
    s: Symbol
    low: Symbol
    high: Symbol

    @staticmethod
    def of(n: int, m: int) -> Reduced:
        """With n joints and m rows."""
        return Reduced(
            Symbol.matrix("J", (m, n), "m/rad", "Jacobian"),
            Symbol.vector("s", m, "m/s", "e/epsilon"),
            Symbol.vector("low", n, "rad/s", "d-"),
            Symbol.vector("high", n, "rad/s", "d+"),
        )

    @property
    def symbols(self) -> tuple[Symbol, ...]:
        """All variables."""
        return self.J, self.s, self.low, self.high

    @property
    def x(self) -> ca.SX:
        """The drive J's, (n, 1)."""
        return self.J.sx.T @ self.s.sx

    @property
    def velocity(self) -> ca.SX:
        """P(J's), (n, 1)."""
        return clip(self.x, self.low.sx, self.high.sx)

    @property
    def fall(self) -> ca.SX:
        """-V'/epsilon = s'J P(J's), (1, 1)."""
        return ca.dot(self.s.sx, self.J.sx @ self.velocity)

    @property
    def zero_inside(self) -> ca.SX:
        """Not negative where 0 lies in the box, (2n, 1)."""
        return ca.vertcat(-self.low.sx, self.high.sx)

    def example(self) -> dict[str, list[int]]:
        """Everything 0, the box [-1, 1]."""
        point = {s.name: [0] * s.size for s in self.symbols}
        n = self.low.size
        return point | {"low": [-1] * n, "high": [1] * n}
