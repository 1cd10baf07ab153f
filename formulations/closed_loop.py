"""Exact task velocity with position feedback, the honest form of eq. (7)."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.formulations.task import (
    POSITION,
    Task,
    require_positive,
    target,
    tracking,
    velocity,
)
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol

_CITATION = (
    "Y. Li, S. Li, B. Hannaford, IEEE Trans. Industrial Informatics "
    "15(4):2054-2063, 2019, doi:10.1109/TII.2018.2869588, eqs. (3), (7), (10); "
    "feedback in the constraint: L. Sciavicco, B. Siciliano, IEEE J. Robotics and "
    "Automation 4(4):403-410, 1988, doi:10.1109/56.804"
)
_NOTES = (
    "Derived in place of (7), whose k e'e has no derivative with respect to the "
    "joint velocity and so changes nothing.  Where a bound is active the rows may "
    "have no solution; slack_task always has one."
)


@checked()
def closed_loop(
    kin: Kinematics,
    *,
    kappa: float = 20.0,
    task: str = POSITION,
    frame: str | None = None,
    c1: float = 0.5,
    c2: float = 0.5,
) -> Formulation:
    """Follow a moving target exactly; errors die out at the rate kappa.

        minimise    1/2 u'u
        subject to  rd_dot + kappa e - J(q) u = 0
                    d-(q) <= u <= d+(q)                            (10)

    The error obeys e' = rd_dot - J u = -kappa e wherever the programme is
    feasible: no lag behind a moving target, and no accumulation.  kappa = 0
    would be ``minimum_velocity``.

    Args:
        kin: kinematics of the robot.
        kappa: rate of the feedback, 1/s; with steps of h seconds keep
            h kappa < 1.
        task: "position": e = rd - r(q), parameters rd and rd_dot (3,);
            "pose": the loop measures ``error`` (6,) itself, linear part
            rd - r, angular part the rotation vector, in base axes, that
            turns the frame into its target (rad); rd_dot is (6,).
        frame: the frame that follows; the tip by default.
        c1: of (10) at the lower limits, 1/s.
        c2: of (10) at the upper limits, 1/s.

    Returns:
        Formulation in the joint velocity ``u`` (nv,) with parameters ``q``,
        ``rd_dot``, and ``rd`` or ``error``.

    Raises:
        RrnnError: kappa, c1 or c2 is not positive; no such task.
        RobotError: there is no such frame.

    Source:
        Li, Li, Hannaford (IEEE TII 2019), eqs. (3), (7), (10); the feedback is
        ours, after Sciavicco and Siciliano 1988: the paper (section II-B) puts
        the error into the objective, where it has no effect.
    """
    require_positive(kappa=kappa)
    u, wanted = velocity(kin), tracking(kin, frame, task)
    error, measured = _error(kin, wanted, frame)
    lower, upper = velocity_bounds(kin.q, kin.robot.limits, c1=c1, c2=c2)
    return Formulation(
        name="closed_loop",
        decision=u,
        parameters=(wanted.q, wanted.rate, measured),
        cost=ca.dot(u.sx, u.sx) / 2,
        equalities=wanted.rate.sx + kappa * error - wanted.jacobian @ u.sx,
        lower=lower,
        upper=upper,
        citation=_CITATION,
        notes=_NOTES,
    )


def _error(kin: Kinematics, wanted: Task, frame: str | None) -> tuple[ca.SX, Symbol]:
    """The error (m, 1), and the parameter that it comes from."""
    if wanted.kind == POSITION:
        rd = target()
        return rd.sx - kin.position(frame), rd
    error = Symbol.vector("error", 6, "m, rad", "pose error, linear then angular")
    return error.sx, error
