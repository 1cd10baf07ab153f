"""C19: the projection inequality (20), as it is printed."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.verification import (
    ClaimCase,
    Instance,
    Mutation,
    Proof,
    Repair,
    Square,
)
from rrnn_opt.verification.lemmas import clip, projection
from rrnn_opt.verification.vocabulary import scalars, stated


def case(kinematics: Kinematics) -> ClaimCase:
    """|P(x) - x|^2 <= |y - x| for y in Omega, on the line.

    One side is squared and the other is not.  With Omega = [2, 4], x = 0 and
    y = 3 it says 4 <= 3.  With both sides squared it is true:

        (y - x)^2 - (P(x) - x)^2 = (y - P(x))^2 + 2 (x - P(x))(P(x) - y)

    Args:
        kinematics: not used.
    """
    x, y, low, high = scalars("x y low high")
    p = clip(x.sx, low.sx, high.sx)
    inside = ca.vertcat(y.sx - low.sx, high.sx - y.sx)
    printed, mended = (
        Claim(
            id="C19",
            source="eq. (20)",
            statement=statement,
            variables=(x, y, low, high),
            goal=Relation(right - (p - x.sx) ** 2, ">=0"),
            hypotheses=(stated("H1", "y lies in Omega", inside),),
        )
        for statement, right in (
            ("|P(x) - x|^2 <= |y - x| for every y in Omega", ca.fabs(y.sx - x.sx)),
            ("|P(x) - x|^2 <= |y - x|^2 for every y in Omega", (y.sx - x.sx) ** 2),
        )
    )
    at = {"x": x.sx, "s": p, "y": y.sx, "low": low.sx, "high": high.sx}
    terms = (Square(y.sx - p), Instance(0, at, factor=ca.SX(2)))
    example = {"x": (0,), "y": (3,), "low": (2,), "high": (4,)}
    proof = Proof(mended, (projection(),), (terms,), example=example)
    mutation = Mutation("right side squared", proof, holds=True)
    return ClaimCase(printed, mutation, (example,), Repair(proof))
