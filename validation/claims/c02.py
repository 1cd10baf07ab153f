"""C2: the Moore-Penrose inverse is J'(J J')^-1, section I."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation
from rrnn_opt.verification.vocabulary import added


def case(kinematics: Kinematics) -> ClaimCase:
    """X = J'(J J')^-1 satisfies the four equations of Penrose, J of 2 x 3.

    Read with X = N / D, N = J' adj(J J') and D = det(J J'), so that no division
    is left: J N J = D J, N J N = D N, and J N and N J are symmetric.  X is there
    only where D > 0, which the paper does not ask for; the mutation asks for it
    everywhere, and a straight arm refutes that.

    Args:
        kinematics: not used; the statement is about any Jacobian.
    """
    J = Symbol.matrix("J", (2, 3), "m/rad", "Jacobian")
    gram = J.sx @ J.sx.T
    D = gram[0, 0] * gram[1, 1] - gram[0, 1] * gram[1, 0]
    adjugate = ca.vertcat(
        ca.horzcat(gram[1, 1], -gram[0, 1]), ca.horzcat(-gram[1, 0], gram[0, 0])
    )
    N = J.sx.T @ adjugate
    parts = (
        J.sx @ N @ J.sx - D * J.sx,
        N @ J.sx @ N - D * N,
        J.sx @ N - (J.sx @ N).T,
        N @ J.sx - (N @ J.sx).T,
    )
    equations = ca.vertcat(*(ca.vec(part) for part in parts))
    claim = Claim(
        id="C2",
        source="section I",
        statement="J'(J J')^-1 is the Moore-Penrose inverse of J",
        variables=(J,),
        goal=Relation(equations, "==0"),
        hypotheses=(added("A1", "J has full row rank: det(J J') > 0", D, ">0"),),
    )
    variant = Claim("C2", "section I", "J J' is regular", (J,), Relation(D, ">0"))
    return ClaimCase(
        claim,
        Mutation("full rank claimed of every J", variant),
        example={"J": (1, 0, 0, 1, 0, 0)},
    )
