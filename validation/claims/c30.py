"""C30: the "pain" of the memory cell decays, section II-D."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.networks import MemoryCell
from rrnn_opt.robot import Kinematics
from rrnn_opt.verification import ClaimCase, Mutation, Repair
from rrnn_opt.verification.vocabulary import added, between, scalars, stated


def case(kinematics: Kinematics) -> ClaimCase:
    """Without collisions x' < 0 for 0 < x <= 1, with A = 0.9 and w = 0.95.

    x' = -A x + (1 - x) w x = (w - A) x - w x^2 is positive below (w - A)/w, so
    the activity rises to about 0.053 there.  It decays for w <= A.

    Args:
        kinematics: not used.
    """
    x, A, w = scalars("x A w")
    cell = MemoryCell()
    positive = stated("H1", "x > 0", x.sx, ">0")
    printed = Claim(
        id="C30",
        source="section II-D",
        statement="without collisions the activity decays (A = 0.9, w = 0.95)",
        variables=(x,),
        goal=Relation(cell.derivative(x.sx, ca.SX(0)), "<0"),
        hypotheses=(positive,),
        domain=(between(x, 0, 1),),
        order="first-order",
    )
    rate = -A.sx * x.sx + (1 - x.sx) * (w.sx * x.sx)
    mended = Claim(
        id="C30",
        source="section II-D",
        statement="for 0 < w <= A the activity decays",
        variables=(x, A, w),
        goal=Relation(rate, "<0"),
        hypotheses=(
            positive,
            added("A1", "w <= A", A.sx - w.sx),
            stated("H2", "w > 0", w.sx, ">0"),
        ),
        domain=(between(x, 0, 1),),
        order="first-order",
    )
    mutation = Mutation("w <= A", mended, holds=True)
    return ClaimCase(printed, mutation, ({"x": (1 / 32,)},), Repair(mended))
