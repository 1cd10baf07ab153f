"""Prioritised tasks: position exactly, orientation as well as then possible."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.formulations.task import POSE, require_positive, tracking
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol

_CITATION = (
    "Y. Nakamura, H. Hanafusa, T. Yoshikawa, Int. J. Robotics Research 6(2):3-15, "
    "1987, doi:10.1177/027836498700600201; B. Siciliano, J.-J. Slotine, Int. Conf. "
    "Advanced Robotics, 1991, pp. 1211-1216"
)
_NOTES = (
    "Two levels.  The first is a hard row and always exact; the second is least "
    "squares in what the first leaves, exact up to the ridge, which stands in for the "
    "third level (least norm).  Three exact levels would need a second programme."
)


@checked()
def prioritised_tasks(
    kin: Kinematics,
    *,
    ridge: float = 1e-4,
    frame: str | None = None,
    c1: float = 0.5,
    c2: float = 0.5,
) -> Formulation:
    """Move a frame's origin exactly, and turn the frame in what is left.

        minimise    1/2 s's + ridge/2 u'u
        subject to  v - J_v(q) u = 0          first:  linear velocity
                    w - J_w(q) u - s = 0      second: angular velocity
                    d-(q) <= u <= d+(q)                            (10)

    with rd_dot = (v, w).  Without active bounds, and N = I - J_v# J_v,

        u = J_v# v + (J_w N)' (J_w N (J_w N)' + ridge I)^-1 (w - J_w J_v# v),

    the null-space projection of a second task with its damped inverse; no
    projector has to be formed, the hard row is the projector.  As ridge goes
    to 0 this is the lexicographic optimum.  Where a pose cannot be followed
    (six rows, fewer free joints), ``minimum_velocity`` has no solution.

    Args:
        kin: kinematics of the robot.
        ridge: damping of the second level, 1.
        frame: the frame that follows; the tip by default.
        c1: of (10) at the lower limits, 1/s.
        c2: of (10) at the upper limits, 1/s.

    Returns:
        Formulation in ``u`` (nv + 3,), the joint velocity and then s (rad/s),
        with parameters ``q`` (nv,) and ``rd_dot`` (6,).

    Raises:
        RrnnError: ridge, c1 or c2 is not positive.
        RobotError: there is no such frame.

    Source:
        Nakamura, Hanafusa, Yoshikawa 1987; the programme and its bounds, which
        the closed form cannot have, are ours.
    """
    require_positive(ridge=ridge)
    nv, task = kin.robot.nv, tracking(kin, frame, POSE)
    both = Symbol.vector("u", nv + 3, "rad/s or m/s", "joint velocity, then slack")
    u, s = both.sx[:nv], both.sx[nv:]
    lower, upper = velocity_bounds(kin.q, kin.robot.limits, c1=c1, c2=c2)
    free = ca.SX(ca.repmat(ca.inf, 3, 1))
    return Formulation(
        name="prioritised_tasks",
        decision=both,
        parameters=(task.q, task.rate),
        cost=ca.dot(s, s) / 2 + ridge / 2 * ca.dot(u, u),
        equalities=task.rate.sx - task.jacobian @ u - ca.vertcat(ca.SX(3, 1), s),
        lower=ca.vertcat(lower, -free),
        upper=ca.vertcat(upper, free),
        citation=_CITATION,
        notes=_NOTES,
    )
