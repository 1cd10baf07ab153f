"""C25: velocities between zero and (11) avoid a collision."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation
from rrnn_opt.verification.vocabulary import added, between, not_negative, scalars


def case(kinematics: Kinematics) -> ClaimCase:
    """|r - o|^2 does not shrink for r' = s * a (r - o), 0 <= s_i <= 1, a >= 0.

    Between zero and the escape velocity is read component by component; o is
    the nearest point of the obstacle.

    Args:
        kinematics: not used; the statement is about a point.
    """
    gap, s = Symbol.vector("gap", 3, "m", "r - o"), Symbol.vector("s", 3)
    (a,) = scalars("a")
    growth = ca.dot(gap.sx, s.sx * a.sx * gap.sx)
    claim, variant = (
        Claim(
            id="C25",
            source="eq. (11)",
            statement="a critical point that moves between zero and a(r - o) does "
            "not come nearer",
            variables=(gap, s, a),
            goal=Relation(growth, ">=0"),
            hypotheses=(added("A1", "the obstacle is convex and stands still"),),
            domain=(between(s, least, 1), *not_negative(a)),
            order="first-order",
        )
        for least in (0, -1)
    )
    return ClaimCase(claim, Mutation("s_i down to -1", variant))
