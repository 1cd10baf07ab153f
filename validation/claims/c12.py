"""C12: with (8) the drive of (6a) is P(J'lam), eq. (16)."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation, Repair


def case(kinematics: Kinematics) -> ClaimCase:
    """The drive u - dL/du is J'lam for L of (8), differentiated automatically.

    With u'u in (8) it is -u + J'lam; with u'u/2 it is J'lam.

    Args:
        kinematics: kinematics of the robot.
    """
    n = kinematics.robot.nv
    q = Symbol("q", kinematics.q, "rad or m", "joint positions")
    u = Symbol.vector("u", n, "rad/s or m/s", "joint velocity")
    lam, rate = Symbol.vector("lam", 3), Symbol.vector("rd_dot", 3, "m/s")
    rd, k = Symbol.vector("rd", 3, "m"), Symbol.scalar("k")
    J, e = kinematics.jacobian(), rd.sx - kinematics.position()

    def drive(weight: float) -> Relation:
        cost = weight * ca.dot(u.sx, u.sx) + k.sx * ca.dot(e, e)
        L = cost + ca.dot(lam.sx, rate.sx - J @ u.sx)
        return Relation(u.sx - ca.gradient(L, u.sx) - J.T @ lam.sx, "==0")

    printed, mended = (
        Claim(
            id="C12",
            source="eq. (8), (16)",
            statement=statement,
            variables=(q, u, lam, rate, rd, k),
            goal=drive(weight),
            order="second-order",
        )
        for statement, weight in (
            ("u - dL/du = J'lam with L of (8), cost u'u + k e'e", 1.0),
            ("u - dL/du = J'lam with the cost u'u/2 + k e'e, so W = I/2", 0.5),
        )
    )
    zeros = {s.name: [0] * s.size for s in printed.variables}
    mutation = Mutation("cost u'u/2", mended, holds=True)
    return ClaimCase(printed, mutation, (zeros | {"u": [1] * n},), Repair(mended))
