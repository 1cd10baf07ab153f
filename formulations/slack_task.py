"""A task that may give way: slack where limits or obstacles leave no room."""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.contacts import clearance_rows, contacts_of
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.formulations.task import (
    POSITION,
    require_not_negative,
    require_positive,
    tracking,
)
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol

_CITATION = (
    "J. Haviland, P. Corke, IEEE Robotics and Automation Letters 6(2):1043-1050, "
    "2021, doi:10.1109/LRA.2021.3056060 (task slack in a velocity QP)"
)
_NOTES = (
    "The task is never met exactly: along a singular value sigma of J the share "
    "delta^2 / (sigma^2 + delta^2) is left undone, also where it could be done.  "
    "Inside d_safe the clearance rows may contradict the box all the same."
)


@checked()
def slack_task(
    kin: Kinematics,
    *,
    contacts: Sequence[int] = (),
    delta: float = 0.01,
    delta_angular: float = 0.01,
    gamma: float = 5.0,
    safe: float = 0.02,
    task: str = POSITION,
    frame: str | None = None,
    c1: float = 0.5,
    c2: float = 0.5,
) -> Formulation:
    """Follow a task velocity as well as limits and obstacles allow.

        minimise    1/2 u'u + 1/2 s's
        subject to  rd_dot - J(q) u - delta s = 0
                    n_i'J_i(q) u >= -gamma (d_i - d_safe)    for contact i
                    d-(q) <= u <= d+(q)                            (10)

    delta s is what the tip does not do of rd_dot; with it the programme has a
    solution for every rd_dot, which ``minimum_velocity`` (delta = 0) has not.
    A small delta means a dear slack: the cost of a miss v is |v / delta|^2.
    Without active bounds u = J'(J J' + delta^2 I)^-1 rd_dot.

    Args:
        kin: kinematics of the robot.
        contacts: index of the robot's sphere in each contact; none: no rows.
        delta: scale of the slack of linear rows, m.
        delta_angular: delta of the angular rows of a pose, 1.
        gamma: rate at which a clearance may shrink, 1/s.
        safe: d_safe, m.
        task: "position" or "pose", as in ``minimum_velocity``.
        frame: the frame that follows; the tip by default.
        c1: of (10) at the lower limits, 1/s.
        c2: of (10) at the upper limits, 1/s.

    Returns:
        Formulation in ``u`` (nv + m,), the joint velocity and then s, with
        parameters ``q`` (nv,), ``rd_dot`` (m,), m = 3 or 6, and, with k
        contacts, ``normals`` (3, k) and ``clearances`` (k,).

    Raises:
        RrnnError: a setting is not positive; no such sphere; no such task.
        RobotError: there is no such frame.

    Source:
        After Haviland and Corke 2021, whose obstacle row is this one with the
        obstacle's own velocity, and whose slack weight follows the error.
    """
    require_positive(delta=delta, delta_angular=delta_angular, gamma=gamma)
    require_not_negative(safe=safe)
    nv, wanted = kin.robot.nv, tracking(kin, frame, task)
    meaning, unit = "joint velocity, then slack", "rad/s or m/s"
    both = Symbol.vector("u", nv + wanted.size, unit, meaning)
    u, found = both.sx[:nv], contacts_of(kin, contacts)
    scales = ca.SX([delta] * 3 + [delta_angular] * (wanted.size - 3))
    lower, upper = velocity_bounds(kin.q, kin.robot.limits, c1=c1, c2=c2)
    free = ca.SX(ca.repmat(ca.inf, wanted.size, 1))
    return Formulation(
        name="slack_task",
        decision=both,
        parameters=(wanted.q, wanted.rate, *found.symbols),
        cost=ca.dot(both.sx, both.sx) / 2,
        equalities=wanted.rate.sx - wanted.jacobian @ u - scales * both.sx[nv:],
        inequalities=clearance_rows(found, u, gamma=gamma, safe=safe),
        lower=ca.vertcat(lower, -free),
        upper=ca.vertcat(upper, free),
        citation=_CITATION,
        notes=_NOTES,
    )
