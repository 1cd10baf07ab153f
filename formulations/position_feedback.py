"""Position feedback, eq. (17), as the box QP whose network it is."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol, require_shape

_CITATION = (
    "Y. Li, S. Li, B. Hannaford, IEEE Trans. Industrial Informatics "
    "15(4):2054-2063, 2019, doi:10.1109/TII.2018.2869588, eqs. (10), (17)"
)
_NOTES = (
    "(17) does not follow from (7): k e'e has no derivative with respect to the "
    "joint velocity.  It is (6a) on this box QP, or (6) with e/epsilon measured "
    "in place of an integrated lambda.  A moving target leaves a lag; an active "
    "joint limit can stop it short of a reachable target."
)


def position_feedback(
    kin: Kinematics,
    *,
    epsilon: float = 0.01,
    frame: str | None = None,
    c1: float = 0.5,
    c2: float = 0.5,
) -> Formulation:
    """Go towards a fixed target position by feedback of the error.

        minimise    1/2 u'u - (1/epsilon) e'J(q) u,    e = rd - position(q)
        subject to  d-(q) <= u <= d+(q)                            (10)

    Its optimum is u = P_Omega(J'e/epsilon), the reduced law (18), and its
    network ``PrimalDual(epsilon)`` is exactly

        epsilon u' = -u + P_Omega(J' (1/epsilon) (rd - r)).        (17)

    Args:
        kin: kinematics of the robot.
        epsilon: inverse of the feedback gain, s; (17) has this same number as
            the network's time constant, so give ``PrimalDual`` the same.
        frame: the frame that goes; the tip by default.
        c1: of (10) at the lower limits, 1/s.
        c2: of (10) at the upper limits, 1/s.

    Returns:
        Formulation in the joint velocity ``u`` (nv,) with parameters ``q``
        (nv,) and ``rd`` (3,).

    Raises:
        RrnnError: epsilon, c1 or c2 is not positive.
        RobotError: there is no such frame.

    Source:
        Li, Li, Hannaford (IEEE TII 2019), eqs. (10), (17); the box QP is ours.
    """
    if not 0.0 < epsilon < float("inf"):
        raise RrnnError(f"epsilon {epsilon}: it must be positive and finite")
    u = Symbol.vector("u", kin.robot.nv, "rad/s or m/s", "joint velocity")
    q = Symbol("q", kin.q, "rad or m", "joint positions")
    rd = Symbol.vector("rd", 3, "m", "target position of the frame")
    J, r = kin.jacobian(frame), kin.position(frame)
    require_shape(J, (3, kin.robot.nv), "Jacobian")
    require_shape(r, (3, 1), "position")
    attraction = J.T @ ((rd.sx - r) / epsilon)
    lower, upper = velocity_bounds(kin.q, kin.robot.limits, c1=c1, c2=c2)
    return Formulation(
        name="position_feedback",
        decision=u,
        parameters=(q, rd),
        cost=ca.dot(u.sx, u.sx) / 2 - ca.dot(attraction, u.sx),
        lower=lower,
        upper=upper,
        citation=_CITATION,
        notes=_NOTES,
    )
