"""C16: (17) cancels the error that (16) keeps."""

from __future__ import annotations

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Given, Mutation, Proof
from rrnn_opt.verification.vocabulary import added, stated


def case(kinematics: Kinematics) -> ClaimCase:
    """In a steady state of (17), where e stands still, e = 0; two rows, 3 joints.

    Steady: u = J'e/epsilon and J u = rd_dot, with s = e/epsilon.  For a target
    at rest and J of full rank, det(J J') s = adj(J J') J J's = 0.  That such a
    state is reached is the decay of the modes eps^2 x^2 + eps x + sigma^2.

    Args:
        kinematics: not used; the statement is about any Jacobian.
    """
    J = Symbol.matrix("J", (2, 3), "m/rad", "Jacobian")
    s, rate = Symbol.vector("s", 2, "m/s", "e/epsilon"), Symbol.vector("rd_dot", 2)
    gram = J.sx @ J.sx.T
    det = gram[0, 0] * gram[1, 1] - gram[0, 1] * gram[1, 0]
    steady = stated("H1", "the error stands still", gram @ s.sx - rate.sx, "==0")
    rank = added("A1", "J has full row rank, no bound is active", det, ">0")
    still = added("A2", "the target stands still", rate.sx, "==0")
    claim, variant = (
        Claim(
            id="C16",
            source="eq. (17)",
            statement="(17) leaves no error: det(J J') e = 0 in a steady state",
            variables=(J, s, rate),
            goal=Relation(det * s.sx, "==0"),
            hypotheses=hypotheses,
            order="second-order",
            jacobian="frozen",
        )
        for hypotheses in ((steady, rank, still), (steady, rank))
    )
    adjugate = ((gram[1, 1], -gram[0, 1]), (-gram[1, 0], gram[0, 0]))
    terms = tuple(
        tuple(Given(h, k, row[k]) for h in (0, 2) for k in range(2)) for row in adjugate
    )
    example = {"J": (1, 0, 0, 1, 0, 0), "s": (0, 0), "rd_dot": (0, 0)}
    rule = "its modes eps^2 x^2 + eps x + sigma^2 = 0 decay for sigma > 0 (Hurwitz)"
    proof = Proof(claim, (), terms, (rule,), example)
    return ClaimCase(proof, Mutation("a target that moves", variant))
