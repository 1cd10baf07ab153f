"""Obstacle avoidance by sign sets on the joints, eqs. (11)-(12)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.contacts import Contacts, contacts_of, near
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.formulations.task import (
    positions,
    regulation_cost,
    require_not_negative,
    target,
    velocity,
)
from rrnn_opt.robot import Kinematics

Reading = Literal["transpose", "index"]

_CITATION = (
    "Y. Li, S. Li, B. Hannaford, IEEE Trans. Industrial Informatics "
    "15(4):2054-2063, 2019, doi:10.1109/TII.2018.2869588, eqs. (9)-(12), (17)"
)
_NOTES = (
    "(12) compares a velocity in space with intervals of joints, so it must be read. "
    " 'transpose' keeps each clearance from shrinking, but forbids joints one by one: "
    "two contacts can freeze the arm.  'index' admits motion into the obstacle.  The "
    "set jumps as a contact comes near; (11) plays no part but its direction."
)


@checked()
def joint_sign_sets(
    kin: Kinematics,
    *,
    contacts: Sequence[int] = (),
    reading: Reading = "transpose",
    safe: float = 0.05,
    epsilon: float = 0.01,
    frame: str | None = None,
    c1: float = 0.5,
    c2: float = 0.5,
) -> Formulation:
    """Position feedback (17) within the box (10) cut by the sign sets (12).

        minimise    1/2 u'u - (1/epsilon) e'J(q) u,    e = rd - r(q)
        subject to  u_j in [d-_j, 0]  where the escape is negative
                    u_j in [0, d+_j]  otherwise,   contacts with d_i <= d_safe
                    d-(q) <= u <= d+(q)                            (10)

    The escape velocity a (r_o - o_o) of (11) points along the normal n_i.
    Its sign for joint j is that of

    * ``transpose``: (J_i' n_i)_j, for joints that move the sphere.  Then
      n_i'J_i u is a sum of terms that are not negative.
    * ``index``: the j-th Cartesian component of n_i, for j = 1, 2, 3, as the
      indices of the print would have it.  A planar arm straight along y
      with n = (1, 0, 0) may then turn its first joint forwards, which
      carries the tip along -x.

    Args:
        kin: kinematics of the robot.
        contacts: index of the robot's sphere in each contact.
        reading: of (12).
        safe: d_safe, clearance at and below which a contact is critical, m.
        epsilon: inverse of the feedback gain, s, as in ``position_feedback``.
        frame: the frame that goes; the tip by default.
        c1: of (10) at the lower limits, 1/s.
        c2: of (10) at the upper limits, 1/s.

    Returns:
        Formulation in the joint velocity ``u`` (nv,) with parameters ``q``
        (nv,), ``rd`` (3,) and, with k contacts, ``normals`` (3, k) and
        ``clearances`` (k,).

    Raises:
        RrnnError: an unknown reading; no such sphere; a gain is not positive.
        RobotError: there is no such frame.

    Source:
        Li, Li, Hannaford (IEEE TII 2019), eqs. (9)-(12), (17): with it the paper's
        own scheme is complete.  d_safe is not given there.
    """
    if reading not in ("transpose", "index"):
        raise RrnnError(f"reading '{reading}': use 'transpose' or 'index'")
    require_not_negative(safe=safe)
    u, rd, found = velocity(kin), target(), contacts_of(kin, contacts)
    lower, upper = velocity_bounds(kin.q, kin.robot.limits, c1=c1, c2=c2)
    for i in range(len(contacts)):
        escape = _escape(found, i, reading)
        critical = near(found.clearances.sx[i], safe)
        for j, sign in escape.items():
            back = sign < 0
            upper[j] = ca.if_else(ca.logic_and(critical, back), 0, upper[j])
            held = ca.logic_and(critical, ca.logic_not(back))
            lower[j] = ca.if_else(held, 0, lower[j])
    return Formulation(
        name="joint_sign_sets",
        decision=u,
        parameters=(positions(kin), rd, *found.symbols),
        cost=regulation_cost(kin, u, rd, frame=frame, epsilon=epsilon),
        lower=lower,
        upper=upper,
        citation=_CITATION,
        notes=_NOTES,
    )


def _escape(found: Contacts, i: int, reading: Reading) -> dict[int, ca.SX]:
    """What decides the sign for a joint, by joint; joints without are free."""
    normal, J = found.normals.sx[:, i], found.jacobians[i]
    if reading == "index":
        return {j: normal[j] for j in range(min(3, J.size2()))}
    moving = [j for j in range(J.size2()) if not J[:, j].is_zero()]
    return {j: ca.dot(J[:, j], normal) for j in moving}
