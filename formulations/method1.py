"""Method 1: velocity level, sign rows at obstacles, no position feedback."""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.contacts import Contacts, contacts_of
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.formulations.signs import (
    Band,
    active,
    magnitudes,
    sign_jacobian,
    threefold,
)
from rrnn_opt.formulations.task import tracking, velocity
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol

_CITATION = (
    "after Y. Zhang, J. Wang, IEEE Trans. Systems, Man, and Cybernetics B "
    "34(1):752-759, 2004, which is Method 1 of Li, Li, Hannaford, IEEE TII 15(4), "
    "2019"
)
_NOTES = (
    "A reconstruction: the distances and the shape of the variable magnitude are "
    "ours.  No error is fed back, so noise and first errors are integrated.  Sign "
    "rows forbid every Cartesian component towards the obstacle: motion along an "
    "oblique wall can be blocked, and the task velocity with it."
)


@checked()
def method1(
    kin: Kinematics,
    *,
    contacts: Sequence[int] = (),
    strict: bool = False,
    band: Band = Band(),  # noqa: B008  frozen
    frame: str | None = None,
    c1: float = 0.5,
    c2: float = 0.5,
) -> Formulation:
    """Minimum velocity along an open-loop task, with sign rows at obstacles.

        minimise    1/2 u'u
        subject to  rd_dot - J(q) u = 0
                    -diag(sgn n_i) J_i(q) u <= b_i,   contacts with d_i <= d2
                    d-(q) <= u <= d+(q)                            (10)

    Three rows a contact: sphere i lies at the gap d_i along the outward
    normal n_i.  Their right side has a variable magnitude: on entering d2 the
    loop stores b0_i = max(-diag(sgn n_i) J_i qd, 0) (``entry_magnitudes`` of
    signs.py), and b_i = s(d_i) b0_i falls smoothly to 0 at d1.  ``strict`` is
    the other reading of the 2004 paper, b_i = 0.

    Args:
        kin: kinematics of the robot.
        contacts: index of the robot's sphere in each contact; none: no rows.
        strict: b = 0 in place of the variable magnitude.
        band: d1 and d2, m.
        frame: the frame that follows; the tip by default.
        c1: of (10) at the lower limits, 1/s.
        c2: of (10) at the upper limits, 1/s.

    Returns:
        Formulation in the joint velocity ``u`` (nv,) with parameters ``q``
        (nv,), ``rd_dot`` (3,) and, with k contacts, ``normals`` (3, k),
        ``clearances`` (k,) and, not strict, ``magnitudes`` (3k,).

    Raises:
        RrnnError: no such sphere; c1 or c2 is not positive.
        RobotError: there is no such frame.

    Source:
        Reconstructed from public descriptions of Zhang and Wang 2004, which
        solves it with a dual network.  The form of s, the positive part at
        entry, d1 and d2 are our choice; limits as in (10), which has the
        form beta (q+ - q) of that school.
    """
    u, task = velocity(kin), tracking(kin, frame)
    near, stored = contacts_of(kin, contacts), magnitudes(len(contacts))
    variable = () if strict or not contacts else (stored,)
    allowed = stored.sx * (0 if strict else 1)
    lower, upper = velocity_bounds(kin.q, kin.robot.limits, c1=c1, c2=c2)
    return Formulation(
        name="method1",
        decision=u,
        parameters=(task.q, task.rate, *near.symbols, *variable),
        cost=ca.dot(u.sx, u.sx) / 2,
        equalities=task.rate.sx - task.jacobian @ u.sx,
        inequalities=_rows(near, u, allowed, band),
        lower=lower,
        upper=upper,
        citation=_CITATION,
        notes=_NOTES,
    )


def _rows(near: Contacts, u: Symbol, allowed: ca.SX, band: Band) -> ca.SX | None:
    """Sign rows J_N u - s(d) b0 <= 0, switched off beyond the outer distance."""
    if not near.jacobians:
        return None
    limit = threefold(band.share(near.clearances.sx)) * allowed
    return active(near, band.outer) * (sign_jacobian(near) @ u.sx - limit)
