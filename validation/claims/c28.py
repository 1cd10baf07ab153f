"""C28: the random attraction (13) works for every g that is not 0."""

from __future__ import annotations

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation, Repair
from rrnn_opt.verification.vocabulary import added, scalars, stated


def case(kinematics: Kinematics) -> ClaimCase:
    """Under r' = g (r_random - r) the distance to r_random falls, on one axis.

    With g = -1 it grows as exp(t).

    Args:
        kinematics: not used; the statement is about a point.
    """
    gap, g = Symbol.scalar("gap", "m", "r_random - r"), scalars("g")[0]
    rate = -2 * gap.sx * (g.sx * gap.sx)
    away = stated("H1", "r is not r_random", gap.sx**2, ">0")
    nonzero = stated("H2", "g is not 0", g.sx**2, ">0")
    printed, mended = (
        Claim(
            id="C28",
            source="eq. (13)",
            statement=statement,
            variables=(gap, g),
            goal=Relation(rate, "<0"),
            hypotheses=hypotheses,
            order="first-order",
        )
        for statement, hypotheses in (
            ("g not 0: the point is attracted by r_random", (away, nonzero)),
            ("g > 0: it is", (away, added("A1", "g > 0", g.sx, ">0"))),
        )
    )
    mutation = Mutation("g > 0", mended, holds=True)
    return ClaimCase(printed, mutation, ({"gap": (1,), "g": (-1,)},), Repair(mended))
