"""C14: the multiplier is lam_0 + (rd - rd_0 - (r - r_0))/epsilon, eq. (15)."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation


def case(kinematics: Kinematics) -> ClaimCase:
    """d/dt (epsilon lam - e) = 0 along (6b), r = f(q), target moving at rd_dot.

    Both sides of (15) agree at t = 0 and have this derivative.  (The print has a
    dot on rd_0 once, a slip: the integral of rd_dot is rd - rd_0.)

    Args:
        kinematics: kinematics of the robot.
    """
    q = Symbol("q", kinematics.q, "rad or m", "joint positions")
    u = Symbol.vector("u", kinematics.robot.nv, "rad/s or m/s", "joint velocity")
    rate = Symbol.vector("rd_dot", 3, "m/s", "velocity of the target")
    epsilon_lam_rate = rate.sx - kinematics.jacobian() @ u.sx  # (6b)
    velocity = ca.jtimes(kinematics.position(), q.sx, u.sx)
    claim, variant = (
        Claim(
            id="C14",
            source="eq. (15)",
            statement="epsilon lam - e does not change along (6b)",
            variables=(q, u, rate),
            goal=Relation(epsilon_lam_rate - sign * (rate.sx - velocity), "==0"),
            order="second-order",
            jacobian="moving",
        )
        for sign in (1, -1)
    )
    return ClaimCase(claim, Mutation("epsilon lam + e", variant))
