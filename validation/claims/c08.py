"""C8: (6) settles for every symmetric W, not only for a positive definite one."""

from __future__ import annotations

from dataclasses import replace

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation, Repair
from rrnn_opt.verification.vocabulary import (
    Programme,
    added,
    not_negative,
    stated,
)


def case(kinematics: Kinematics) -> ClaimCase:
    """Away from the bounds both modes of (6) decay: one joint, one row, W >= 0.

    A linear system settles from everywhere only if all its modes decay, which
    for two modes says: minus their sum and their product, read off the Jacobian
    of (6) without its bounds, are positive.  W = 0 and J = 1 give the sum 0:
    u and lam circle for ever.

    Args:
        kinematics: not used; the statement is about any Jacobian.
    """
    p = Programme.of(1, 1)
    gain, W, J = Symbol.scalar("gain", "1/s", "1/epsilon"), p.w.sx, p.J.sx
    law = gain.sx * ca.vertcat(-p.gradient(p.u.sx, p.lam.sx), p.rows(p.u.sx))
    modes = _decaying(ca.jacobian(law, ca.vertcat(p.u.sx, p.lam.sx)))
    variables = (p.w, p.J, gain)
    positive = (
        stated("H1", "epsilon > 0", gain.sx, ">0"),
        stated("H2", "J is not 0", J**2, ">0"),
    )
    printed = Claim(
        id="C8",
        source="eq. (6)",
        statement="(6) settles for every symmetric W that is not negative",
        variables=variables,
        goal=modes,
        hypotheses=positive,
        domain=not_negative(p.w),
        order="second-order",
        jacobian="frozen",
    )
    mended = replace(
        printed,
        statement="both modes decay for W > 0",
        hypotheses=(*positive, added("A1", "W is positive definite", W, ">0")),
        domain=(),
    )
    witness = {"w": (0,), "J": (1,), "gain": (1,)}
    mutation = Mutation("W > 0", mended, holds=True)
    return ClaimCase(printed, mutation, (witness,), Repair(mended))


def _decaying(slope: ca.SX) -> Relation:
    """Both eigenvalues of a 2 by 2 Jacobian have negative real parts."""
    decay = -(slope[0, 0] + slope[1, 1])
    product = slope[0, 0] * slope[1, 1] - slope[0, 1] * slope[1, 0]
    return Relation(ca.vertcat(decay, product), ">0")
