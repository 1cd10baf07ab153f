"""C13: minimising (7) feeds the error back."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.formulations import closed_loop
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation, Repair
from rrnn_opt.verification.vocabulary import stated

KAPPA = 20.0


def case(kinematics: Kinematics) -> ClaimCase:
    """From rest, the descent of (7) in u moves the arm towards its target.

    Read as: wherever J'e is not 0, -d(7)/du at u = 0 has a positive component
    along J'e, which is the direction in which |e| falls.  (7) holds e(q), which
    does not depend on u: the gradient is 0 there.  What does feed e back is the
    row of ``closed_loop``, under which e' = -kappa e.

    Args:
        kinematics: kinematics of the robot.
    """
    n = kinematics.robot.nv
    q = Symbol("q", kinematics.q, "rad or m", "joint positions")
    u, rd = Symbol.vector("u", n, "rad/s or m/s"), Symbol.vector("rd", 3, "m")
    k = Symbol.scalar("k")
    e = rd.sx - kinematics.position()
    pull = kinematics.jacobian().T @ e
    cost = ca.dot(u.sx, u.sx) + k.sx * ca.dot(e, e)
    descent = -ca.substitute(ca.gradient(cost, u.sx), u.sx, ca.SX.zeros(n))
    printed = Claim(
        id="C13",
        source="eq. (7)",
        statement="minimising u'u + k e'e over u directs the arm to reduce e",
        variables=(q, rd, k),
        goal=Relation(ca.dot(descent, pull), ">0"),
        hypotheses=(
            stated("H1", "k > 0", k.sx, ">0"),
            stated("H2", "J'e is not 0", ca.dot(pull, pull), ">0"),
        ),
        order="first-order",
        jacobian="moving",
    )
    witness = {"q": [0.5] * n, "rd": (1, 1, 0), "k": (100,)}
    mended = _closed_loop(kinematics)
    mutation = Mutation("closed_loop: e' = -kappa e", mended, holds=True)
    return ClaimCase(printed, mutation, (witness,), Repair(mended))


def _closed_loop(kinematics: Kinematics) -> Claim:
    """The rows of ``closed_loop`` are e' + kappa e."""
    form = closed_loop(kinematics, kappa=KAPPA)
    q, rate, rd = form.parameters
    e = rd.sx - kinematics.position()
    moved = ca.jtimes(e, q.sx, form.decision.sx) + rate.sx
    return Claim(
        id="C13",
        source="eq. (3b), (7)",
        statement="the rows of closed_loop are e' + kappa e: with them e' = -kappa e",
        variables=(form.decision, *form.parameters),
        goal=Relation(moved + KAPPA * e - form.equalities, "==0"),
        order="first-order",
        jacobian="moving",
    )
