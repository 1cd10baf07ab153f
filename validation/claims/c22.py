"""C22: the box (10) is not empty and holds 0."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.verification import ClaimCase, Mutation
from rrnn_opt.verification.vocabulary import added, scalars, stated


def case(kinematics: Kinematics) -> ClaimCase:
    """d- <= 0 <= d+ for one joint; (10) acts on each alone.

    Args:
        kinematics: not used; the statement is about any joint.
    """
    q, lowest, highest, slowest, fastest, c1, c2 = scalars(
        "q q_low q_high w_low w_high c1 c2"
    )
    low = ca.fmax(-c1.sx * (q.sx - lowest.sx), slowest.sx)
    high = ca.fmin(-c2.sx * (q.sx - highest.sx), fastest.sx)
    signs = ca.vertcat(-slowest.sx, fastest.sx, c1.sx, c2.sx, highest.sx - lowest.sx)
    stands = stated("H1", "w- <= 0 <= w+, c1, c2 >= 0, q- <= q+", signs)
    inside = ca.vertcat(q.sx - lowest.sx, highest.sx - q.sx)
    claim, variant = (
        Claim(
            id="C22",
            source="eq. (9)-(10)",
            statement="d- <= 0 <= d+: Omega is not empty, and holds 0",
            variables=(q, lowest, highest, slowest, fastest, c1, c2),
            goal=Relation(ca.vertcat(-low, high), ">=0"),
            hypotheses=hypotheses,
        )
        for hypotheses in (
            (stands, added("A1", "q- <= q <= q+", inside)),
            (stands,),
        )
    )
    example = {
        "q": (0,), "q_low": (-1,), "q_high": (1,), "w_low": (-1,), "w_high": (1,),
        "c1": (1,), "c2": (1,),
    }  # fmt: skip
    return ClaimCase(claim, Mutation("q outside its limits", variant), example=example)
