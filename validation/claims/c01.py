"""C1: the velocity of the end effector is J times that of the joints, eq. (1)."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation


def case(kinematics: Kinematics) -> ClaimCase:
    """d/dt f(q) = J(q) q' for every posture and velocity.

    Read as: the derivative of the forward kinematics along q', by automatic
    differentiation, is the geometric Jacobian, written by hand, times q'.

    Args:
        kinematics: kinematics of the robot.
    """
    q = Symbol("q", kinematics.q, "rad or m", "joint positions")
    u = Symbol.vector("u", kinematics.robot.nv, "rad/s or m/s", "joint velocities")
    rate = ca.jtimes(kinematics.position(), q.sx, u.sx)
    claim, variant = (
        Claim(
            id="C1",
            source="eq. (1)",
            statement=statement,
            variables=(q, u),
            goal=Relation(rate - factor * (kinematics.jacobian() @ u.sx), "==0"),
            order="first-order",
            jacobian="moving",
        )
        for statement, factor in (("r' = J(q) q'", 1), ("r' = 2 J(q) q'", 2))
    )
    return ClaimCase(claim, Mutation("J doubled", variant))
