"""C20a: V' <= 0 along (18), eq. (21)."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.validation.claims.reduced import Reduced
from rrnn_opt.verification import (
    ClaimCase,
    Instance,
    Mutation,
    Proof,
    Repair,
    Square,
)
from rrnn_opt.verification.lemmas import projection
from rrnn_opt.verification.vocabulary import added


def case(kinematics: Kinematics) -> ClaimCase:
    """For 7 joints, 3 rows, every J, e and box with 0, e'J P(J'e/epsilon) >= 0.

    The projection at x against y = 0, once a joint: x P = P^2 + (x - P)(P - 0).
    So V' <= -epsilon |P|^2, twice what the paper keeps.  (20) puts y = 0 into
    Omega without saying so; without it the statement is false.

    Args:
        kinematics: not used; the statement is about any Jacobian.
    """
    law = Reduced.of(7, 3)
    printed = _proof(law, 0.0, "-e'J P(J'e/epsilon) <= 0")
    sharper = _proof(law, 1.0, "V' <= -epsilon |P(J'e/epsilon)|^2")
    variant = Claim(
        id="C20a",
        source="eq. (21)",
        statement="the same for a box without 0",
        variables=law.symbols,
        goal=Relation(law.fall, ">=0"),
        hypotheses=(added("A0", "Omega is not empty", law.high.sx - law.low.sx),),
    )
    return ClaimCase(
        printed, Mutation("0 outside the box", variant), (), Repair(sharper)
    )


def _proof(law: Reduced, share: float, statement: str) -> Proof:
    """Fall - share |P|^2 >= 0."""
    x, p = law.x, law.velocity
    claim = Claim(
        id="C20a",
        source="eq. (21)",
        statement=statement,
        variables=law.symbols,
        goal=Relation(law.fall - share * ca.dot(p, p), ">=0"),
        hypotheses=(added("A1", "0 lies in Omega", law.zero_inside),),
        order="first-order",
        jacobian="moving",
    )
    terms: list[Instance | Square] = []
    for i in range(law.low.size):
        at = {"x": x[i], "s": p[i], "y": ca.SX(0)}
        box = {"low": law.low.sx[i], "high": law.high.sx[i]}
        terms.append(Instance(0, at | box))
        terms.append(Square(p[i], ca.SX(1 - share)))
    return Proof(claim, (projection(),), (tuple(terms),), example=law.example())
