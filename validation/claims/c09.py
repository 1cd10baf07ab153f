"""C9: the multiplier of (6b) stays bounded."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation, Repair
from rrnn_opt.verification.energy import Frozen, decrease
from rrnn_opt.verification.vocabulary import Programme, stated


def case(kinematics: Kinematics) -> ClaimCase:
    """No direction y in which lam' is positive whatever u in Omega does.

    epsilon y lam' = y (rd_dot - J u) is at least y rd_dot - max over Omega of
    y J u; where that is positive, y lam grows at a constant rate for ever,
    since (6a) keeps u in Omega.  Read with one joint: for all J, rd_dot, Omega
    and y it is not positive.  J = 1, Omega = [-1, 1], rd_dot = 2 and y = 1 give
    a rate of at least 1/epsilon.  Where (3) is feasible and W > 0 the energy of
    C7 bounds lam.

    Args:
        kinematics: not used; the statement is about any Jacobian.
    """
    p, y = Programme.of(1, 1), Symbol.scalar("y")
    along = p.J.sx * y.sx
    least = y.sx * p.rate.sx - ca.fmax(along * p.low.sx, along * p.high.sx)
    printed = Claim(
        id="C9",
        source="eq. (6b)",
        statement="lam stays bounded: it has no direction of constant growth",
        variables=(p.J, p.rate, p.low, p.high, y),
        goal=Relation(least, "<=0"),
        hypotheses=(stated("H1", "Omega is not empty", p.high.sx - p.low.sx),),
        order="second-order",
        jacobian="frozen",
    )
    witness = {"J": (1,), "rd_dot": (2,), "low": (-1,), "high": (1,), "y": (1,)}
    mended = decrease(Frozen.of(3, 2), "C9")
    mutation = Mutation("(3) feasible, W > 0: V of C7 bounds lam", mended, holds=True)
    return ClaimCase(printed, mutation, (witness,), Repair(mended))
