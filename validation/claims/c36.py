"""C36: Table I, "theoretical error: zero" for the proposed scheme."""

from __future__ import annotations

from fractions import Fraction

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation, Repair
from rrnn_opt.verification.document import Witness
from rrnn_opt.verification.vocabulary import added, stated


def case(kinematics: Kinematics) -> ClaimCase:
    """(17) follows a target that moves steadily without an error; J = 1.

    Steady: u = gain e and u = rd_dot, so e = rd_dot/gain: with epsilon = 1/20
    and 0.1 m/s it is 5 mm.  Of the row's other columns, "global convergence" is
    C21, "no accumulation" C15, "physical limits" C23, "obstacles" C26 and
    "completeness" C34.

    Args:
        kinematics: not used; one joint is enough.
    """
    e, gain = Symbol.scalar("e", "m"), Symbol.scalar("gain", "1/s", "1/epsilon")
    rate = Symbol.scalar("rd_dot", "m/s", "velocity of the target")
    steady = stated("H1", "the error stands still", gain.sx * e.sx - rate.sx, "==0")
    positive = stated("H2", "epsilon > 0", gain.sx, ">0")
    printed, mended = (
        Claim(
            id="C36",
            source="Table I",
            statement=statement,
            variables=(e, gain, rate),
            goal=Relation(e.sx, "==0"),
            hypotheses=hypotheses,
            order="second-order",
        )
        for statement, hypotheses in (
            ("the theoretical error of (17) is zero", (steady, positive)),
            (
                "it is zero for a target at rest, away from bounds",
                (steady, positive, added("A1", "rd stands still", rate.sx, "==0")),
            ),
        )
    )
    witness: Witness = {
        "e": (Fraction(1, 200),),
        "gain": (20,),
        "rd_dot": (Fraction(1, 10),),
    }
    mutation = Mutation("a target at rest", mended, holds=True)
    return ClaimCase(printed, mutation, (witness,), Repair(mended))
