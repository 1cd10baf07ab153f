"""C19: the projection inequality (20), as it is printed."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Hypothesis, Relation
from rrnn_opt.symbolic import Box, Symbol
from rrnn_opt.verification import ClaimCase, Mutation, Status


def case() -> ClaimCase:
    """|P(x) - x|^2 <= |y - x| for y in Omega, on the line.

    One side is squared and the other is not.  With Omega = [2, 4], x = 0 and
    y = 3 it says 4 <= 3.

    Returns:
        The case; its mutation squares both sides, which is true.
    """
    x, y = Symbol.scalar("x", "1", "point"), Symbol.scalar("y", "1", "in Omega")
    low, high = Symbol.scalar("low"), Symbol.scalar("high")
    squared = (Box(low.sx, high.sx).project(x.sx) - x.sx) ** 2
    inside = ca.vertcat(y.sx - low.sx, high.sx - y.sx)
    printed, mended = (
        Claim(
            id="C19",
            source="eq. (20)",
            statement=statement,
            variables=(x, y, low, high),
            goal=Relation(right - squared, ">=0"),
            hypotheses=(Hypothesis("A1", "y lies in Omega", Relation(inside, ">=0")),),
        )
        for statement, right in (
            ("|P(x) - x|^2 <= |y - x| for every y in Omega", ca.fabs(y.sx - x.sx)),
            ("|P(x) - x|^2 <= |y - x|^2 for every y in Omega", (y.sx - x.sx) ** 2),
        )
    )
    mutation = Mutation("right side squared", mended, Status.REFUTED)
    witness = {"x": (0,), "y": (3,), "low": (2,), "high": (4,)}
    return ClaimCase(printed, Status.REFUTED, mutation, (witness,))
