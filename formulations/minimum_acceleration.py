"""Minimum joint acceleration with feedback and limits that hold."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.acceleration_limits import braking_bounds
from rrnn_opt.formulations.task import (
    acceleration,
    joint_velocity,
    require_positive,
    target,
    target_acceleration,
    tracking,
)
from rrnn_opt.robot import Kinematics

_CITATION = (
    "acceleration level: A. De Luca, G. Oriolo, B. Siciliano, Laboratory Robotics "
    "and Automation 4(2), 1992; feedback: J. Luh, M. Walker, R. Paul, IEEE "
    "Trans. Automatic Control 25(3):468-474, 1980"
)
_NOTES = (
    "Self-motion is not damped: minimum acceleration lets joints go on turning "
    "behind a tip that rests.  Near a stop the bounds may exclude the task."
)


@checked()
def minimum_acceleration(
    kin: Kinematics,
    *,
    kappa: float = 10.0,
    mu_v: float = 20.0,
    frame: str | None = None,
) -> Formulation:
    """Follow a target with the smallest joint acceleration, errors dying out.

        minimise    1/2 u'u,   u the joint acceleration
        subject to  rd_ddot + 2 kappa (rd_dot - J qd) + kappa^2 (rd - r)
                    - J'(q, qd) qd - J(q) u = 0              (J' = dJ/dt)
                    u <= min(omega^2 (q+ - q) - 2 omega qd, mu_v (w - qd), a)
                    and its mirror image,  omega = a / w

    w being the largest speed and a the largest acceleration
    (``braking_bounds``).  The error obeys e'' + 2 kappa e' + kappa^2 e = 0.
    Against ``method2`` two terms are new: the feedback, and bounds whose
    position term is damped, so that they are kept for ever and never contradict
    each other.

    Args:
        kin: kinematics of the robot.
        kappa: both poles of the error, 1/s.
        mu_v: rate of the speed bound, 1/s.
        frame: the frame that follows; the tip by default.

    Returns:
        Formulation in the joint acceleration ``u`` (nv,) with parameters ``q``
        and ``qd`` (nv,), ``rd``, ``rd_dot`` and ``rd_ddot`` (3,).

    Raises:
        RrnnError: kappa is not positive, or mu_v too small.
        RobotError: there is no such frame.

    Source:
        Resolved acceleration of Luh, Walker, Paul 1980 as the equality of a
        least-norm programme; the bounds are ours.
    """
    require_positive(kappa=kappa)
    u, qd, task = acceleration(kin), joint_velocity(kin), tracking(kin, frame)
    rd, wanted = target(), target_acceleration()
    slip = task.rate.sx - task.jacobian @ qd.sx
    error = rd.sx - kin.position(frame)
    drift = kin.jacobian_dot(frame, qd.sx) @ qd.sx
    asked = wanted.sx + 2 * kappa * slip + kappa**2 * error
    lower, upper = braking_bounds(kin.q, qd.sx, kin.robot.limits, mu_v=mu_v)
    return Formulation(
        name="minimum_acceleration",
        decision=u,
        parameters=(task.q, qd, rd, task.rate, wanted),
        cost=ca.dot(u.sx, u.sx) / 2,
        equalities=asked - drift - task.jacobian @ u.sx,
        lower=lower,
        upper=upper,
        citation=_CITATION,
        notes=_NOTES,
        level="acceleration",
    )
