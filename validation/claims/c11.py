"""C11: (6) follows the optimum while J(q), Omega(q) and rd_dot move."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation, Repair
from rrnn_opt.verification.vocabulary import added, stated


def case(kinematics: Kinematics) -> ClaimCase:
    """|z - z*|^2 does not grow although z* moves; one joint, W = 1/2, no bounds.

        epsilon z' = -F(z),   z* = (rd_dot/J, rd_dot/J^2),   z*' = m

    The paper lets the network run on moving data and says nothing of how fast
    they may move; "slowly enough" is then a hypothesis in words, and nothing
    can be decided.  The repaired statement is of a cell of J: with data that
    stand still, one quadratic form decreases for every J in [1/2, 2].

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
    mended = _cell(u, lam, J)
    mutation = Mutation("data that stand still, J in a cell", mended, holds=True)
    return ClaimCase(printed, mutation, repaired=Repair(mended))


def _cell(u: Symbol, lam: Symbol, J: Symbol) -> Claim:
    """d/dt (x'Q x) <= -2 alpha x'Q x, alpha = 1/16, in the time unit epsilon."""
    x = ca.vertcat(u.sx, lam.sx)
    Q = ca.SX([[1, -0.25], [-0.25, 1]])
    law = ca.vertcat(-u.sx + J.sx * lam.sx, -J.sx * u.sx)
    rate = 2 * x.T @ Q @ law + x.T @ Q @ x / 8
    return Claim(
        id="C11",
        source="eq. (6)",
        statement="for J in [1/2, 2] and data at rest x'Q x decays at the rate "
        "1/8 /epsilon, one Q for the whole cell (W = 1/2, away from bounds)",
        variables=(u, lam, J),
        goal=Relation(rate, "<=0"),
        hypotheses=(
            added("A1", "J lies in [1/2, 2]", ca.vertcat(J.sx - 0.5, 2 - J.sx)),
        ),
        order="second-order",
        jacobian="frozen",
    )
