"""Quiet posture: feedback, and self-motion to where joint noise matters least."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.formulations.task import require_positive, target, tracking, velocity
from rrnn_opt.robot import Kinematics

_CITATION = (
    "ours; self-motion by a gradient: A. Liegeois, IEEE Trans. Systems, Man, and "
    "Cybernetics 7(12):868-871, 1977, doi:10.1109/TSMC.1977.4309644; limits (10) "
    "of Li, Li, Hannaford, IEEE TII 15(4), 2019"
)
_NOTES = (
    "The measure takes the joints' noise as white, independent and of one size; joints "
    "that turn and joints that slide do not share a unit.  Where a bound is active the "
    "rows may have no solution."
)


@checked()
def quiet_posture(
    kin: Kinematics,
    *,
    kappa: float = 20.0,
    gain: float = 5.0,
    frame: str | None = None,
    c1: float = 0.5,
    c2: float = 0.5,
) -> Formulation:
    """Follow a target with feedback, from postures where noise matters least.

        minimise    1/2 |u + gain grad(1/2 |J|_F^2)|^2
        subject to  rd_dot + kappa e - J(q) u = 0,    e = rd - r(q)
                    d-(q) <= u <= d+(q)                            (10)

    Noise n on the joint velocities moves the tip by J n; with independent
    entries of variance s^2 that has the mean square s^2 |J|_F^2, which no
    feedback can take back before it is seen.  The posture decides it, and a
    redundant arm has postures to choose from.  ``closed_loop`` (gain = 0) is
    as exact without noise, and stays where it was.

    Args:
        kin: kinematics of the robot.
        kappa: rate of the feedback, 1/s; with steps of h seconds the error
            from white noise is least at h kappa = 1.
        gain: of the descent, rad2/(s m2).
        frame: the frame that follows; the tip by default.
        c1: of (10) at the lower limits, 1/s.
        c2: of (10) at the upper limits, 1/s.

    Returns:
        Formulation in the joint velocity ``u`` (nv,) with parameters ``q``
        (nv,), ``rd_dot`` and ``rd`` (3,).

    Raises:
        RrnnError: kappa, gain, c1 or c2 is not positive.
        RobotError: there is no such frame.

    Source:
        Ours: what |J|_F does to white noise is derived above; descent by
        self-motion after Liegeois 1977, the limits (10) of Li, Li, Hannaford
        (IEEE TII 2019).
    """
    require_positive(kappa=kappa, gain=gain)
    u, rd, task = velocity(kin), target(), tracking(kin, frame)
    lower, upper = velocity_bounds(kin.q, kin.robot.limits, c1=c1, c2=c2)
    descent = -ca.gradient(ca.sumsqr(task.jacobian) / 2, kin.q)
    error = rd.sx - kin.position(frame)
    return Formulation(
        name="quiet_posture",
        decision=u,
        parameters=(task.q, task.rate, rd),
        cost=ca.dot(u.sx, u.sx) / 2 - gain * ca.dot(descent, u.sx),
        equalities=task.rate.sx + kappa * error - task.jacobian @ u.sx,
        lower=lower,
        upper=upper,
        citation=_CITATION,
        notes=_NOTES,
    )
