"""C27: the scheme with (12) still converges."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation, Repair
from rrnn_opt.verification.lemmas import clip
from rrnn_opt.verification.vocabulary import scalars, stated


def case(kinematics: Kinematics) -> ClaimCase:
    """-V' = x P(x) > 0 for a joint with x = J'e/epsilon not 0, and two contacts.

    The argument of LaSalle asks for it.  Each contact cuts the box of the joint
    to [d-, 0] or [0, d+] by the sign of its escape velocity (12).  Two contacts
    of opposite signs leave {0}: the arm rests with J'e not 0.  What remains is
    V' <= 0, as 0 is in every such set.

    Args:
        kinematics: not used; the statement is about any joint.
    """
    x, low, high = scalars("x low high")
    escape = Symbol.vector("escape", 2, "m/s", "escape velocities, their component")
    back = ca.fmin(escape.sx[0], escape.sx[1]) < 0
    forth = ca.fmax(escape.sx[0], escape.sx[1]) >= 0
    least, most = ca.if_else(forth, 0, low.sx), ca.if_else(back, 0, high.sx)
    fall = x.sx * clip(x.sx, least, most)
    box = stated("H1", "d- < 0 < d+", ca.vertcat(-low.sx, high.sx), ">0")
    moved = stated("H2", "J'e is not 0", x.sx**2, ">0")
    printed, mended = (
        Claim(
            id="C27",
            source="eq. (12), LaSalle",
            statement=statement,
            variables=(x, low, high, escape),
            goal=Relation(fall, sense),
            hypotheses=hypotheses,
            order="first-order",
        )
        for statement, sense, hypotheses in (
            ("with (12), V' = 0 only where J'e = 0", ">0", (box, moved)),
            ("with (12), V' <= 0", ">=0", (box,)),
        )
    )
    witness = {"x": (1,), "low": (-1,), "high": (1,), "escape": (1, -1)}
    mutation = Mutation("V' <= 0 in place of < 0", mended, holds=True)
    return ClaimCase(printed, mutation, (witness,), Repair(mended))
