"""C7: the network (6) settles at the optimum of (3), data standing still."""

from __future__ import annotations

from rrnn_opt.robot import Kinematics
from rrnn_opt.verification import ClaimCase, Mutation, Proof
from rrnn_opt.verification.energy import RULES, Frozen, decrease


def case(kinematics: Kinematics) -> ClaimCase:
    """V' <= -2 (u - u*)'W(u - u*) - 2 d'W d along (6), and V >= |z - z*|^2/2.

        V = -F'd - |d|^2/2 + |z - z*|^2/2,   z = (u, lam),  d = P(z - F(z)) - z

    for 7 joints and 3 rows, every W, J, c, rd_dot and box, in the time unit
    epsilon; no bound on the step of time, and J may lose rank.  Two scalar
    lemmas a joint carry the inequality: the projection at z against z*, and at
    z* against z.  The mutation drops the hypothesis that u starts in the box.

    Args:
        kinematics: not used; the statement is about any Jacobian.
    """
    frozen = Frozen.of(7, 3)
    proof = decrease(frozen, "C7")
    loose = Proof(
        frozen.claim("C7", "u(0) anywhere", frozen.margins, inside=False),
        proof.lemmas,
        proof.terms,
        RULES,
        frozen.example(),
    )
    return ClaimCase(proof, Mutation("u(0) outside the box", loose))
