"""C39: the totals of Table IV are the sums of their parts."""

from __future__ import annotations

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation
from rrnn_opt.verification.vocabulary import pinned

RANDOM = ("2080/100", "1988/100", "5666/100", "5276/100")
HEURISTIC = ("2146/100", "292/100", "5660/100", "542/100")
TOTAL = ("4226/100", "2280/100", "11326/100", "5818/100")


def case(kinematics: Kinematics) -> ClaimCase:
    """RE + HS = Total in both scenarios, without learning and proposed.

    Args:
        kinematics: not used; the table's own numbers are summed.
    """
    random, heuristic, total = (
        Symbol.vector(name, 4, "1", "mean of 50 runs") for name in ("RE", "HS", "total")
    )
    claim, variant = (
        Claim(
            id="C39",
            source="Table IV",
            statement="the totals are the sums of random and heuristic explorations",
            variables=(random, heuristic, total),
            goal=Relation(random.sx + heuristic.sx - total.sx, "==0"),
            domain=(
                pinned(random, RANDOM),
                pinned(heuristic, HEURISTIC),
                pinned(total, sums),
            ),
        )
        for sums in (TOTAL, (*TOTAL[:3], "5819/100"))
    )
    return ClaimCase(claim, Mutation("last total off by 0.01", variant))
