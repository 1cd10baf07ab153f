"""C18: the derivative of V along the reduced law (18), eq. (19)."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.claim import Claim, Relation
from rrnn_opt.dynamics import NeuralDynamics
from rrnn_opt.lyapunov import LyapunovFunction
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Box, Symbol
from rrnn_opt.verification import ClaimCase, Mutation


def case(kinematics: Kinematics) -> ClaimCase:
    """V' = -e'J P(J'e/epsilon) for q' = P(J'e/epsilon) and a fixed target.

    V = 1/2 e'e is differentiated automatically through the forward kinematics;
    J is the geometric Jacobian, written by hand.  The claim is for every
    posture, target, gain 1/epsilon and box.

    Args:
        kinematics: kinematics of the robot.

    Returns:
        The case; its mutation drops a column of J.
    """
    law, error, jacobian = reduced_law(kinematics)
    energy = ca.dot(error, error) / 2
    rate = LyapunovFunction(energy, law.state, law.parameters).derivative(law)
    claim = _claim(law, rate + ca.dot(error, jacobian @ law.output))
    tip_column = _first_moving_column(jacobian)
    broken = ca.SX(jacobian)
    broken[:, tip_column] = 0
    variant = _claim(law, rate + ca.dot(error, broken @ law.output))
    text = f"column {tip_column + 1} of J dropped"
    return ClaimCase(claim, Mutation(text, variant))


def reduced_law(kinematics: Kinematics) -> tuple[NeuralDynamics, ca.SX, ca.SX]:
    """The law (18) with any box and gain; also e and J.

    Args:
        kinematics: kinematics of the robot.

    Returns:
        Dynamics with state q, the error (3, 1) in m, the Jacobian (3, nv).
    """
    n = kinematics.robot.nv
    q = Symbol("q", kinematics.q, "rad or m", "joint positions")
    rd = Symbol.vector("rd", 3, "m", "target position")
    gain = Symbol.scalar("gain", "1/s", "1/epsilon")
    lower = Symbol.vector("lower", n, "rad/s or m/s", "least joint velocity")
    upper = Symbol.vector("upper", n, "rad/s or m/s", "largest joint velocity")
    error = rd.sx - kinematics.position()
    jacobian = kinematics.jacobian()
    drive = gain.sx * (jacobian.T @ error)
    velocity = ca.SX(Box(lower.sx, upper.sx).project(drive))
    law = NeuralDynamics(
        name="reduced_law",
        state=q,
        parameters=(rd, gain, lower, upper),
        derivative=velocity,
        output=velocity,
        residual=velocity,
        notes="(18): (17) without its second derivative",
    )
    return law, error, jacobian


def _claim(law: NeuralDynamics, difference: ca.SX) -> Claim:
    return Claim(
        id="C18",
        source="eq. (18)-(19)",
        statement="V' = -e'J P(J'e/epsilon) along q' = P(J'e/epsilon), rd fixed",
        variables=(law.state, *law.parameters),
        goal=Relation(difference, "==0"),
        order="first-order",
        jacobian="moving",
    )


def _first_moving_column(jacobian: ca.SX) -> int:
    """A column that is not identically zero."""
    return next(k for k in range(jacobian.size2()) if not jacobian[:, k].is_zero())
