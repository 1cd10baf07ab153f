"""C11: (6) follows the optimum while J(q), Omega(q) and rd_dot move."""

from __future__ import annotations

from fractions import Fraction

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.decay import DecayClaim
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation, Repair
from rrnn_opt.verification.vocabulary import added, stated


def case(kinematics: Kinematics) -> ClaimCase:
    """|z - z*|^2 does not grow although z* moves; one joint, W = 1/2, no bounds.

        epsilon z' = -F(z),   z* = (rd_dot/J, rd_dot/J^2),   z*' = m

    The paper lets the network run on moving data and says nothing of how fast
    they may move; "slowly enough" is then a hypothesis in words, and nothing
    can be decided.  The repaired statement is of a cell of J: one quadratic form
    decreases for every J(t) in [1/2, 2], by a linear matrix inequality.

    Args:
        kinematics: not used; the statement is about any Jacobian.
    """
    u, lam = Symbol.scalar("u", "rad/s"), Symbol.scalar("lam")
    J, gain = Symbol.scalar("J", "m/rad"), Symbol.scalar("gain", "1/s", "1/epsilon")
    move = Symbol.vector("m", 2, "1", "velocity of the optimum")
    x = ca.vertcat(u.sx, lam.sx)  # seen from z*
    law = gain.sx * ca.vertcat(-u.sx + J.sx * lam.sx, -J.sx * u.sx)
    slow = stated("H1", "epsilon > 0", gain.sx, ">0")
    printed = Claim(
        id="C11",
        source="eq. (6)",
        statement="the distance from the moving optimum does not grow",
        variables=(u, lam, J, gain, move),
        goal=Relation(ca.dot(x, law - move.sx), "<=0"),
        hypotheses=(slow, added("A1", "the data move slowly enough for epsilon")),
        order="second-order",
        jacobian="moving",
    )
    mended = _cell()
    mutation = Mutation("J in a cell, rd_dot = 0", mended, holds=True)
    return ClaimCase(printed, mutation, repaired=Repair(mended))


def _cell() -> DecayClaim:
    """For every J(t) in the cell z' = [[-1, J], [-J, 0]] z decays at 1/10."""
    ends = (Fraction(1, 2), Fraction(2))
    return DecayClaim(
        id="C11",
        source="eq. (6)",
        statement="while J(t) moves anywhere in [1/2, 2], however fast, (6) decays at "
        "the rate 1/10 /epsilon towards rest (W = 1/2, rd_dot = 0)",
        vertices=tuple(((Fraction(-1), J), (-J, Fraction(0))) for J in ends),
        rate=Fraction(1, 10),
        hypotheses=(added("A1", "J lies in [1/2, 2], no bound is active"),),
        order="second-order",
        jacobian="moving",
    )
