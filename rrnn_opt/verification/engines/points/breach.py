"""How far a point breaks a claim, in floating point."""

from __future__ import annotations

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from rrnn_opt.claim import Claim

Array = NDArray[np.float64]

_WIDTH = 4.0  # half the spread of a variable without bounds
_MARGIN = 1e-7  # by which a search keeps hypotheses, so that rounding does too


class Breach:
    """The goal and hypotheses of a claim over one column of unknowns.

    Attributes:
        lower: bounds of the unknowns, (n,), -inf where there is none.
        upper: (n,).
    """

    def __init__(self, claim: Claim) -> None:
        sizes = [s.size for s in claim.variables]
        x = [ca.vec(s.sx) for s in claim.variables]
        flat = ca.SX.sym("x", sum(sizes))
        parts = ca.vertsplit(flat, [0, *np.cumsum(sizes)])
        y = [ca.vec(r.expression) for r in claim.relations]
        y = ca.substitute(y, x, parts)
        self._senses = [r.sense for r in claim.relations]
        self._values = ca.Function("values", [flat], y)
        kept = [_slack(v, s) for v, s in zip(y[1:], self._senses[1:], strict=True)]
        even = [v for v, s in zip(y[1:], self._senses[1:], strict=True) if s == "==0"]
        slacks, equations = ca.vertcat(*kept), ca.vertcat(*even)
        goal = y[0] if self._senses[0] in (">=0", ">0") else -y[0]
        if self._senses[0] == "==0":
            goal = -ca.fabs(y[0])
        rows = [goal, ca.SX(slacks), ca.SX(equations)]
        self.derivatives = ca.Function(
            "derivatives", [flat], [*rows, *(ca.jacobian(row, flat) for row in rows)]
        )
        self.lower, self.upper = _box(claim)

    def all(self, point: Array) -> list[float]:
        """Largest breach of the goal, then of every hypothesis; <= 0: kept."""
        results = self._values.call([ca.DM(point)])
        values = [np.asarray(v, dtype=np.float64).ravel() for v in results]
        return [_breach(v, s) for v, s in zip(values, self._senses, strict=True)]

    def keeps(self, point: Array) -> bool:
        """Whether the point keeps every hypothesis, and the goal is defined."""
        breaks = self.all(point)
        return bool(np.all(np.isfinite(breaks))) and max(breaks[1:], default=0) <= 0

    def score(self, point: Array) -> float:
        """Positive when the goal is broken and every hypothesis is kept."""
        breaks = self.all(point)
        if not all(np.isfinite(breaks)):
            return -np.inf
        kept = max(breaks[1:], default=0.0)
        return breaks[0] if kept <= 0.0 else -kept - 1e6

    def excess(self, point: Array) -> float:
        """How far the goal is broken, whatever becomes of the hypotheses."""
        return self.all(point)[0]

    def draw(self, rng: np.random.Generator) -> Array:
        """A point of the domain; unbounded unknowns are drawn near the origin."""
        low = np.where(
            np.isfinite(self.lower),
            self.lower,
            np.minimum(-_WIDTH, self.upper - 2 * _WIDTH),
        )
        high = np.where(
            np.isfinite(self.upper), self.upper, np.maximum(_WIDTH, low + 2 * _WIDTH)
        )
        return np.asarray(low + (high - low) * rng.random(low.size))

    def clip(self, point: Array) -> Array:
        """The nearest point of the domain."""
        return np.clip(point, self.lower, self.upper)


def _slack(values: ca.SX, sense: str) -> ca.SX:
    """At least 0 where a relation that is no equation is kept, and clearly."""
    if sense == "==0":
        return ca.SX(0, 1)
    turned = values if sense[0] == ">" else -values
    return turned - _MARGIN


def _breach(values: Array, sense: str) -> float:
    if sense == "==0":
        return float(np.max(np.abs(values)))
    return float(np.max(-values if sense in (">=0", ">0") else values))


def _box(claim: Claim) -> tuple[Array, Array]:
    """Bounds of all variables in one column; infinite where there are none."""
    lower, upper = [], []
    for symbol in claim.variables:
        low, high = np.full(symbol.size, -np.inf), np.full(symbol.size, np.inf)
        for interval in claim.domain:
            if interval.variable == symbol.name:
                for k, (a, b) in enumerate(
                    zip(interval.lower, interval.upper, strict=True)
                ):
                    low[k] = low[k] if a is None else max(low[k], float(a))
                    high[k] = high[k] if b is None else min(high[k], float(b))
        lower.append(low)
        upper.append(high)
    return np.concatenate(lower), np.concatenate(upper)
