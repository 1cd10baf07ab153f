"""C3: a task augmented to as many rows as joints has one solution, eq. (2)."""

from __future__ import annotations

from dataclasses import replace

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Given, Mutation, Proof, Repair
from rrnn_opt.verification.vocabulary import added, stated


def case(kinematics: Kinematics) -> ClaimCase:
    """With s = m - n, q' is unique: J_A u = J_A v implies u = v; m = 2, n = s = 1.

    Two velocities that give the same augmented velocity are to be equal, for
    all rows J and J_y.  J = [1 0] and J_y = [2 0] leave the second joint free.
    The repaired statement asks for det J_A, the absence of an algorithmic
    singularity; it is det(J_A) (u - v) = adj(J_A) J_A (u - v) = 0.

    Args:
        kinematics: not used; the statement is about any Jacobian.
    """
    J, Jy = (Symbol.matrix(name, (1, 2)) for name in ("J", "Jy"))
    u, v = Symbol.vector("u", 2, "rad/s"), Symbol.vector("v", 2, "rad/s")
    JA = ca.vertcat(J.sx, Jy.sx)
    same = stated("H1", "both give the same rate", JA @ (u.sx - v.sx), "==0")
    det = JA[0, 0] * JA[1, 1] - JA[0, 1] * JA[1, 0]
    printed = Claim(
        id="C3",
        source="eq. (2)",
        statement="with s = m - n extra rows the joint velocity is unique",
        variables=(J, Jy, u, v),
        goal=Relation(u.sx - v.sx, "==0"),
        hypotheses=(same,),
    )
    regular = added("A1", "det J_A is not 0", det**2, ">0")
    mended = replace(
        printed,
        statement="where det J_A is not 0 the joint velocity is unique: "
        "det(J_A) (u - v) = 0",
        goal=Relation(det * (u.sx - v.sx), "==0"),
        hypotheses=(same, regular),
    )
    first = (Given(0, 0, JA[1, 1]), Given(0, 1, -JA[0, 1]))
    second = (Given(0, 0, -JA[1, 0]), Given(0, 1, JA[0, 0]))
    example = {"J": (1, 0), "Jy": (0, 1), "u": (1, 1), "v": (1, 1)}
    proof = Proof(mended, terms=(first, second), example=example)
    witness = {"J": (1, 0), "Jy": (2, 0), "u": (0, 0), "v": (0, 1)}
    return ClaimCase(
        printed, Mutation("det J_A not 0", proof, holds=True), (witness,), Repair(proof)
    )
