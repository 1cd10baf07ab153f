"""Obstacle avoidance by augmenting the task, eq. (2)."""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.contacts import Contacts, contacts_of, near
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.formulations.task import (
    require_not_negative,
    require_positive,
    tracking,
    velocity,
)
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol

_CITATION = (
    "Y. Li, S. Li, B. Hannaford, IEEE Trans. Industrial Informatics "
    "15(4):2054-2063, 2019, doi:10.1109/TII.2018.2869588, eq. (2); O. Egeland, "
    "IEEE J. Robotics and Automation 3(5):469-475, 1987 (task augmentation)"
)
_NOTES = (
    "An equality row uses up a degree of freedom even when the clearance grows by "
    "itself, and ends at algorithmic singularities, where [J; J_y] loses rank "
    "although J and J_y do not; clearance_rows does neither."
)


@checked()
def task_augmentation(
    kin: Kinematics,
    *,
    contacts: Sequence[int] = (),
    gamma: float = 5.0,
    safe: float = 0.05,
    frame: str | None = None,
    c1: float = 0.5,
    c2: float = 0.5,
) -> Formulation:
    """Follow a task velocity, and make clearances grow as further tasks.

        minimise    1/2 u'u
        subject to  [rd_dot; y_dot] - [J; J_y] u = 0                 (2)
                    J_y,i = n_i'J_i,  y_dot_i = gamma (d_safe - d_i)
                    d-(q) <= u <= d+(q)                            (10)

    Row i stands only while contact i is critical, d_i <= d_safe; otherwise
    both its sides are 0.

    Args:
        kin: kinematics of the robot.
        contacts: index of the robot's sphere in each contact, at most as many
            as the arm has degrees of freedom to spare.
        gamma: rate at which a clearance goes to d_safe, 1/s.
        safe: d_safe, m.
        frame: the frame that follows; the tip by default.
        c1: of (10) at the lower limits, 1/s.
        c2: of (10) at the upper limits, 1/s.

    Returns:
        Formulation in the joint velocity ``u`` (nv,) with parameters ``q``
        (nv,), ``rd_dot`` (3,) and, with k contacts, ``normals`` (3, k) and
        ``clearances`` (k,).

    Raises:
        RrnnError: more contacts than spare degrees of freedom (s <= m - n in
            the paper's letters); no such sphere; a gain is not positive.
        RobotError: there is no such frame.

    Source:
        Li, Li, Hannaford (IEEE TII 2019), eq. (2), which leaves f_y open: the
        clearance is our choice.  The paper asks s = m - n for a unique u; the
        least norm makes it unique for fewer rows too, and s = m - n does not
        where [J; J_y] is singular.
    """
    require_positive(gamma=gamma)
    require_not_negative(safe=safe)
    u, task, found = velocity(kin), tracking(kin, frame), contacts_of(kin, contacts)
    spare = kin.robot.nv - task.moving
    if len(contacts) > spare:
        raise RrnnError(f"contacts: {len(contacts)} rows, but only {spare} to spare")
    lower, upper = velocity_bounds(kin.q, kin.robot.limits, c1=c1, c2=c2)
    extra = _rows(found, u, gamma=gamma, safe=safe)
    return Formulation(
        name="task_augmentation",
        decision=u,
        parameters=(task.q, task.rate, *found.symbols),
        cost=ca.dot(u.sx, u.sx) / 2,
        equalities=ca.vertcat(task.rate.sx - task.jacobian @ u.sx, extra),
        lower=lower,
        upper=upper,
        citation=_CITATION,
        notes=_NOTES,
    )


def _rows(found: Contacts, u: Symbol, *, gamma: float, safe: float) -> ca.SX:
    """y_dot - J_y u of the critical contacts, 0 of the others, (k, 1)."""
    if not found.jacobians:
        return ca.SX(0, 1)
    gaps = found.clearances.sx
    critical = ca.vertcat(*[near(gap, safe) for gap in ca.vertsplit(gaps)])
    return critical * (gamma * (safe - gaps) - found.gradients @ u.sx)
