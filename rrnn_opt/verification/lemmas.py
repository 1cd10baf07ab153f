"""Scalar lemmas about the projection onto an interval.

A box projection acts on each coordinate alone, so what one joint satisfies is
summed up over any number of joints (see :mod:`rrnn_opt.verification.composite`).
"""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Hypothesis, Relation
from rrnn_opt.symbolic import Box, Symbol

SOURCE = "projection onto a closed interval"


def clip(x: ca.SX, low: ca.SX, high: ca.SX) -> ca.SX:
    """P(x), the nearest point of [low, high], element by element.

    Args:
        x: (n, 1).
        low: (n, 1).
        high: (n, 1).
    """
    return ca.SX(Box(low, high).project(x))


def projection() -> Claim:
    """(x - s)(s - y) >= 0 for s = P(x) and every y in [low, high].

    Summed over the coordinates it is the variational inequality of the
    projection, from which the corrected (20), (21) and the decrease of the
    energy of (6) follow.
    """
    x, s, y = Symbol.scalar("x"), Symbol.scalar("s"), Symbol.scalar("y")
    low, high = Symbol.scalar("low"), Symbol.scalar("high")
    inside = ca.vertcat(y.sx - low.sx, high.sx - y.sx)
    return Claim(
        id="L1",
        source=SOURCE,
        statement="(x - s)(s - y) >= 0 for s = P(x) and every y in Omega",
        variables=(x, s, y, low, high),
        goal=Relation((x.sx - s.sx) * (s.sx - y.sx), ">=0"),
        hypotheses=(
            Hypothesis(
                "s", "s = P(x)", Relation(clip(x.sx, low.sx, high.sx) - s.sx, "==0")
            ),
            Hypothesis("y", "y in Omega", Relation(inside, ">=0")),
        ),
    )


def slack() -> Claim:
    """It holds that x P(x) >= k x^2 for 0 <= k <= 1, where k x lies in [low, high].

    It is what makes the decrease of V exponential where bounds are slack: with
    |x| <= X and bounds at least delta away from 0, k = min(1, delta/X) will do.
    """
    x, k = Symbol.scalar("x"), Symbol.scalar("k")
    low, high = Symbol.scalar("low"), Symbol.scalar("high")
    inside = ca.vertcat(k.sx * x.sx - low.sx, high.sx - k.sx * x.sx)
    share = ca.vertcat(k.sx, 1 - k.sx)
    moved = x.sx * clip(x.sx, low.sx, high.sx)
    return Claim(
        id="L2",
        source=SOURCE,
        statement="x P(x) >= k x^2 where the share k of x lies in Omega",
        variables=(x, k, low, high),
        goal=Relation(moved - k.sx * x.sx**2, ">=0"),
        hypotheses=(
            Hypothesis("x", "k x lies in Omega", Relation(inside, ">=0")),
            Hypothesis("k", "0 <= k <= 1", Relation(share, ">=0")),
        ),
    )


def limits_hold_zero() -> Claim:
    """(x - s) s >= 0 for s = P(x) on the interval (10) of a joint inside its limits.

    low = max(-c1 (q - q-), w-),   high = min(-c2 (q - q+), w+)
    """
    names = ("x", "q", "lowest", "highest", "slowest", "fastest", "c1", "c2")
    x, q, lowest, highest, slowest, fastest, c1, c2 = map(Symbol.scalar, names)
    low = ca.fmax(-c1.sx * (q.sx - lowest.sx), slowest.sx)
    high = ca.fmin(-c2.sx * (q.sx - highest.sx), fastest.sx)
    s = clip(x.sx, low, high)
    inside = ca.vertcat(q.sx - lowest.sx, highest.sx - q.sx)
    signs = ca.vertcat(-slowest.sx, fastest.sx, c1.sx, c2.sx)
    return Claim(
        id="L3",
        source=f"{SOURCE}; eq. (10)",
        statement="(x - s) s >= 0 for s = P(x), Omega of (10), q inside its limits",
        variables=(x, q, lowest, highest, slowest, fastest, c1, c2),
        goal=Relation((x.sx - s) * s, ">=0"),
        hypotheses=(
            Hypothesis("q", "q- <= q <= q+", Relation(inside, ">=0")),
            Hypothesis("w", "w- <= 0 <= w+, c1, c2 >= 0", Relation(signs, ">=0")),
        ),
    )


def nonexpansive() -> Claim:
    """(x - y)(P(x) - P(y)) >= (P(x) - P(y))^2 on one interval."""
    x, y = Symbol.scalar("x"), Symbol.scalar("y")
    low, high = Symbol.scalar("low"), Symbol.scalar("high")
    gap = clip(x.sx, low.sx, high.sx) - clip(y.sx, low.sx, high.sx)
    ordered = Relation(high.sx - low.sx, ">=0")
    return Claim(
        id="L4",
        source=SOURCE,
        statement="(x - y)(P(x) - P(y)) >= (P(x) - P(y))^2",
        variables=(x, y, low, high),
        goal=Relation((x.sx - y.sx) * gap - gap**2, ">=0"),
        hypotheses=(Hypothesis("order", "low <= high", ordered),),
    )


def complementary() -> Claim:
    """A pair mu = max(mu + g, 0) has mu (g + t) >= 0 for every t >= 0.

    mu and g are then complementary: mu >= 0, g <= 0, mu g = 0.
    """
    mu, g, t = Symbol.scalar("mu"), Symbol.scalar("g"), Symbol.scalar("t")
    rest = Relation(ca.fmax(mu.sx + g.sx, 0) - mu.sx, "==0")
    return Claim(
        id="L5",
        source="projection onto a half-line",
        statement="mu (g + t) >= 0 where mu = max(mu + g, 0) and t >= 0",
        variables=(mu, g, t),
        goal=Relation(mu.sx * (g.sx + t.sx), ">=0"),
        hypotheses=(
            Hypothesis("mu", "mu = max(mu + g, 0)", rest),
            Hypothesis("t", "t >= 0", Relation(t.sx, ">=0")),
        ),
    )
