"""C10: (6) computed in Euler steps settles as the continuous network does."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation, Proof
from rrnn_opt.verification.vocabulary import Programme, added, stated


def case(kinematics: Kinematics) -> ClaimCase:
    """The test of Jury for one step of (6), W = I/2, singular value J of J.

    With k = h/epsilon the step z+ = z + k d has the characteristic polynomial
    s^2 + a s + b, read off its Jacobian; all modes shrink exactly when
    1 + a + b, 1 - a + b and 1 - b are positive.  They are for k J^2 < 1 and
    J >= 1/2, where the modes are a complex pair.

    Args:
        kinematics: not used; the statement is about any singular value.
    """
    p, k = Programme.of(1, 1), Symbol.scalar("k", "1", "h/epsilon")
    drive = ca.substitute(p.gradient(p.u.sx, p.lam.sx), p.w.sx, 0.5)
    state = ca.vertcat(p.u.sx, p.lam.sx)
    step = state + k.sx * ca.vertcat(-drive, p.rows(p.u.sx))
    slope = ca.jacobian(step, state)
    a = -(slope[0, 0] + slope[1, 1])
    b = slope[0, 0] * slope[1, 1] - slope[0, 1] * slope[1, 0]
    jury = Relation(ca.vertcat(1 + a + b, 1 - a + b, 1 - b), ">0")
    positive = (
        stated("H1", "h > 0", k.sx, ">0"),
        added("A2", "sigma >= 1/2", p.J.sx - 0.5),
    )
    bound = added("A1", "h < epsilon / sigma^2", 1 - k.sx * p.J.sx**2, ">0")
    claim, variant = (
        Claim(
            id="C10",
            source="eq. (6)",
            statement="Euler steps of (6) settle, away from the bounds, W = I/2",
            variables=(p.J, k),
            goal=jury,
            hypotheses=hypotheses,
            order="discrete",
            jacobian="frozen",
        )
        for hypotheses in ((*positive, bound), positive)
    )
    example = {"J": (1,), "k": (0.5,)}
    rule = "the singular values of J split (6) into pairs of modes, away from bounds"
    proof = Proof(claim, (claim,), (), (rule,), example)
    return ClaimCase(proof, Mutation("steps of any size", variant))
