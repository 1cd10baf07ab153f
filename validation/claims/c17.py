"""C17: V = 1/2 e'e does not decrease along (17)."""

from __future__ import annotations

from fractions import Fraction

import casadi as ca
import numpy as np

from rrnn_opt.claim import Claim, Range, Relation
from rrnn_opt.formulations import position_feedback
from rrnn_opt.lyapunov import LyapunovFunction
from rrnn_opt.networks import PrimalDual
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation, Proof, Repair
from rrnn_opt.verification.document import Witness
from rrnn_opt.verification.vocabulary import added, joint_ranges

EPSILON = 0.01


def case(kinematics: Kinematics) -> ClaimCase:
    """V' <= 0 along (17), for q inside its limits and u inside the speed limits.

        epsilon u' = -u + P_Omega(J'e/epsilon),  q' = u,  V = 1/2 e'e:  V' = -e'J u

    The law is of second order: right after a reversal of the target the arm
    still moves away from it, and V rises.  The argument of (19) is about the
    first-order law (18).

    Args:
        kinematics: kinematics of the robot.

    Returns:
        The case; its mutation is the equation that does hold along (17).
    """
    form = position_feedback(kinematics, epsilon=EPSILON)
    network = PrimalDual(epsilon=EPSILON)(form)
    q, rd = network.parameters
    error = rd.sx - kinematics.position()
    energy = LyapunovFunction(ca.dot(error, error) / 2, network.state, (q, rd))
    rate = energy.derivative(network, parameter_rates={"q": network.output})
    truth = rate + ca.dot(error, kinematics.jacobian() @ network.output)
    claim, variant = (
        Claim(
            id="C17",
            source="eq. (17), (19)",
            statement=statement,
            variables=(network.state, q, rd),
            goal=goal,
            domain=_limits(kinematics, network.state, q),
            order="second-order",
            jacobian="moving",
        )
        for statement, goal in (
            ("V = 1/2 e'e does not increase along (17)", Relation(rate, "<=0")),
            ("V' = -e'J u along (17)", Relation(truth, "==0")),
        )
    )
    mutation = Mutation("V' <= 0 replaced by V' = -e'J u", variant, holds=True)
    witnesses = (_witness(kinematics),)
    return ClaimCase(claim, mutation, witnesses, Repair(_kinetic()))


def _kinetic() -> Proof:
    """V3' = -gain |J u|^2 for V3 = |J u|^2/2 + sum of the integrals of P_i.

    The integral of P from 0 to x is x P(x) - P(x)^2/2, whose slope is P(x); the
    argument is x = gain J'e, and e' = -J u for a target at rest.
    """
    n, m = 7, 3
    J, u = Symbol.matrix("J", (m, n), "m/rad"), Symbol.vector("u", n, "rad/s")
    e, gain = Symbol.vector("e", m, "m"), Symbol.scalar("gain", "1/s", "1/epsilon")
    P, x_rate = Symbol.vector("P", n, "rad/s", "P(x)"), -gain.sx * J.sx.T @ J.sx @ u.sx
    Ju = J.sx @ u.sx
    u_rate = gain.sx * (P.sx - u.sx)
    rate = ca.dot(Ju, J.sx @ u_rate) + ca.dot(P.sx, x_rate)
    claim = Claim(
        id="C17",
        source="eq. (17)",
        statement="V3 = |J u|^2/2 + sum of integrals of P_i decreases along (17) for "
        "frozen J: V3' = -|J u|^2/epsilon",
        variables=(J, u, e, gain, P),
        goal=Relation(rate + gain.sx * ca.dot(Ju, Ju), "==0"),
        hypotheses=(added("A1", "J and Omega stand still, the target too"),),
        order="second-order",
        jacobian="frozen",
    )
    rule = "the slope of x P(x) - P(x)^2/2 is P(x) (Danskin)"
    return Proof(claim, (claim,), (), (rule,))


def _limits(kinematics: Kinematics, u: Symbol, q: Symbol) -> tuple[Range, ...]:
    speed = tuple(Fraction(x) for x in kinematics.robot.limits.velocity.tolist())
    return (Range(u.name, tuple(-x for x in speed), speed), joint_ranges(kinematics, q))


def _witness(kinematics: Kinematics) -> Witness:
    """A bent arm, a target beside its tip, and a slow motion away from it."""
    limits = kinematics.robot.limits
    lower, upper = np.maximum(limits.lower, -2.0), np.minimum(limits.upper, 2.0)
    bend = np.linspace(0.55, 0.75, kinematics.robot.nv)
    q = _rounded(lower + (upper - lower) * bend)
    pose = ca.Function("p", [kinematics.q], [kinematics.position()])
    jacobian = ca.Function("J", [kinematics.q], [kinematics.jacobian()])
    tip = np.asarray(pose(q), dtype=np.float64).ravel()
    rd = _rounded(tip + 0.125)
    away = -np.asarray(jacobian(q), dtype=np.float64).T @ (rd - tip)
    u = _rounded(away * (0.05 / np.max(np.abs(away))))
    return {"u": u.tolist(), "q": q.tolist(), "rd": rd.tolist()}


def _rounded(values: np.ndarray) -> np.ndarray:
    return np.round(values * 1024) / 1024
