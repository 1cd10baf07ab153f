"""Obstacle avoidance by one linear row a contact, in the clearance."""

from __future__ import annotations

from collections.abc import Sequence

from rrnn_opt.arguments import checked
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.contacts import clearance_rows as rows
from rrnn_opt.formulations.contacts import contacts_of
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.formulations.task import (
    positions,
    regulation_cost,
    require_not_negative,
    require_positive,
    target,
    velocity,
)
from rrnn_opt.robot import Kinematics

_CITATION = (
    "B. Faverjon, P. Tournassoud, IEEE Int. Conf. Robotics and Automation, 1987, "
    "pp. 1152-1159, doi:10.1109/ROBOT.1987.1087982 (velocity damper); in place of "
    "eq. (12) of Li, Li, Hannaford, IEEE TII 15(4), 2019"
)
_NOTES = (
    "Inside d_safe a row asks for retreat, and rows may then contradict each other "
    "or the box; outside, u = 0 is always feasible.  In steps of h seconds "
    "the clearance is kept to first order for h gamma <= 1."
)


@checked()
def clearance_rows(
    kin: Kinematics,
    *,
    contacts: Sequence[int] = (),
    gamma: float = 5.0,
    safe: float = 0.02,
    epsilon: float = 0.01,
    frame: str | None = None,
    c1: float = 0.5,
    c2: float = 0.5,
) -> Formulation:
    """Position feedback (17) with a row that really keeps the distance.

        minimise    1/2 u'u - (1/epsilon) e'J(q) u,    e = rd - r(q)
        subject to  n_i'J_i(q) u >= -gamma (d_i - d_safe)    for contact i
                    d-(q) <= u <= d+(q)                            (10)

    n_i'J_i u is the rate of the clearance d_i itself, whatever joints make
    it.  So d_i - d_safe >= (d_i(0) - d_safe) exp(-gamma t): a sphere may come
    near as fast as its distance allows, slide along the obstacle in any
    direction, and never gets there.  No row switches.

    Args:
        kin: kinematics of the robot.
        contacts: index of the robot's sphere in each contact; none: no rows.
        gamma: rate at which a clearance may shrink, 1/s.
        safe: d_safe, m.
        epsilon: inverse of the feedback gain, s, as in ``position_feedback``.
        frame: the frame that goes; the tip by default.
        c1: of (10) at the lower limits, 1/s.
        c2: of (10) at the upper limits, 1/s.

    Returns:
        Formulation in the joint velocity ``u`` (nv,) with parameters ``q``
        (nv,), ``rd`` (3,) and, with k contacts, ``normals`` (3, k) and
        ``clearances`` (k,).

    Raises:
        RrnnError: no such sphere; a gain is not positive.
        RobotError: there is no such frame.

    Source:
        Faverjon and Tournassoud 1987, in velocities, on (17) and in place of
        eq. (12) of Li, Li, Hannaford (IEEE TII 2019).
    """
    require_positive(gamma=gamma)
    require_not_negative(safe=safe)
    u, rd, found = velocity(kin), target(), contacts_of(kin, contacts)
    lower, upper = velocity_bounds(kin.q, kin.robot.limits, c1=c1, c2=c2)
    return Formulation(
        name="clearance_rows",
        decision=u,
        parameters=(positions(kin), rd, *found.symbols),
        cost=regulation_cost(kin, u, rd, frame=frame, epsilon=epsilon),
        inequalities=rows(found, u.sx, gamma=gamma, safe=safe),
        lower=lower,
        upper=upper,
        citation=_CITATION,
        notes=_NOTES,
    )
