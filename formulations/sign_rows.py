"""Obstacle avoidance by sign rows on the task axes, eqs. (11)-(12)."""

from __future__ import annotations

from collections.abc import Sequence

from rrnn_opt.arguments import checked
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.contacts import contacts_of
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.formulations.signs import active, sign_jacobian
from rrnn_opt.formulations.task import (
    positions,
    regulation_cost,
    require_not_negative,
    target,
    velocity,
)
from rrnn_opt.robot import Kinematics

_CITATION = (
    "Y. Li, S. Li, B. Hannaford, IEEE Trans. Industrial Informatics "
    "15(4):2054-2063, 2019, doi:10.1109/TII.2018.2869588, eqs. (9)-(12), (17)"
)
_NOTES = (
    "Rows are conservative: every Cartesian component towards the obstacle is "
    "forbidden, so sliding along an oblique wall is.  They switch on at d_safe and "
    "know no distance: a sphere at d_safe may not come a hair nearer."
)


@checked()
def sign_rows(
    kin: Kinematics,
    *,
    contacts: Sequence[int] = (),
    safe: float = 0.05,
    epsilon: float = 0.01,
    frame: str | None = None,
    c1: float = 0.5,
    c2: float = 0.5,
) -> Formulation:
    """Position feedback (17) with (12) read along the axes of the task.

        minimise    1/2 u'u - (1/epsilon) e'J(q) u,    e = rd - r(q)
        subject to  -diag(sgn n_i) J_i(q) u <= 0,   contacts with d_i <= d_safe
                    d-(q) <= u <= d+(q)                            (10)

    Each component of the sphere's velocity lies in [d-, 0] or [0, d+] by the
    sign of the escape velocity (11), which has that of the normal; bounds on
    it beyond the sign come from (10).  It is the third reading of (12) beside
    the two of ``joint_sign_sets``, and the rows of ``method1`` with b = 0.

    n_i'J_i u is a sum of terms |n_a| (sgn n_a) (J_i u)_a that are not negative.

    Args:
        kin: kinematics of the robot.
        contacts: index of the robot's sphere in each contact; none: no rows.
        safe: d_safe, clearance at and below which a contact is critical, m.
        epsilon: inverse of the feedback gain, s, as in ``position_feedback``.
        frame: the frame that goes; the tip by default.
        c1: of (10) at the lower limits, 1/s.
        c2: of (10) at the upper limits, 1/s.

    Returns:
        Formulation in the joint velocity ``u`` (nv,) with parameters ``q``
        (nv,), ``rd`` (3,) and, with k contacts, ``normals`` (3, k) and
        ``clearances`` (k,).  u = 0 is feasible within the joint limits.

    Raises:
        RrnnError: no such sphere; a gain is not positive.
        RobotError: there is no such frame.

    Source:
        Li, Li, Hannaford (IEEE TII 2019), eqs. (9)-(12), (17), in a reading of ours.
    """
    require_not_negative(safe=safe)
    u, rd, found = velocity(kin), target(), contacts_of(kin, contacts)
    rows = None
    if len(contacts):
        rows = active(found, safe) * (sign_jacobian(found) @ u.sx)
    lower, upper = velocity_bounds(kin.q, kin.robot.limits, c1=c1, c2=c2)
    return Formulation(
        name="sign_rows",
        decision=u,
        parameters=(positions(kin), rd, *found.symbols),
        cost=regulation_cost(kin, u, rd, frame=frame, epsilon=epsilon),
        inequalities=rows,
        lower=lower,
        upper=upper,
        citation=_CITATION,
        notes=_NOTES,
    )
