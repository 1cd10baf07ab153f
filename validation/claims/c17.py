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
from rrnn_opt.verification import ClaimCase, Mutation, Status
from rrnn_opt.verification.document import Witness

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
    mutation = Mutation("V' <= 0 replaced by V' = -e'J u", variant, Status.REFUTED)
    return ClaimCase(claim, Status.REFUTED, mutation, (_witness(kinematics),))


def _limits(kinematics: Kinematics, u: Symbol, q: Symbol) -> tuple[Range, ...]:
    limits = kinematics.robot.limits
    return (
        Range(u.name, _exact(-limits.velocity), _exact(limits.velocity)),
        Range(q.name, _exact(limits.lower), _exact(limits.upper)),
    )


def _exact(bounds: np.ndarray) -> tuple[Fraction | None, ...]:
    return tuple(Fraction(x) if np.isfinite(x) else None for x in bounds.tolist())


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
