"""The model [35] of Table I (stand-in): tracking with feedback, projected."""

from __future__ import annotations

import casadi as ca
import numpy as np

from rrnn_opt.arguments import checked
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.formulations.task import require_positive, target, tracking, velocity
from rrnn_opt.robot import Kinematics

_CITATION = (
    "stand-in for reference [35] of Y. Li, S. Li, B. Hannaford, IEEE Trans. "
    "Industrial Informatics 15(4):2054-2063, 2019, doi:10.1109/TII.2018.2869588"
)
_NOTES = (
    "A stand-in: which publication [35] is, is not settled.  With position limits it "
    "is the programme of closed_loop under the table's name; such networks project "
    "onto a set that need not be convex, which no QP can say."
)


@checked()
def model35(
    kin: Kinematics,
    *,
    kappa: float = 20.0,
    position_limits: bool = True,
    frame: str | None = None,
    c1: float = 0.5,
    c2: float = 0.5,
) -> Formulation:
    """Tracking with the error fed back through the multiplier.

        minimise    1/2 u'u
        subject to  rd_dot + kappa e - J(q) u = 0,    e = rd - r(q)
                    u in Omega = [d-(q), d+(q)]                    (10)

    ``PrimalDual`` of it has epsilon lambda' = rd_dot - J u + kappa e, the
    tracking form of a projected network with position feedback.  Omega is the
    box (10), to which the table's "physical limits: yes" refers; or, without
    ``position_limits``, the fixed box of speeds, as such networks have it.

    Args:
        kin: kinematics of the robot.
        kappa: rate of the feedback, 1/s.
        position_limits: take the box (10); else only the largest speeds.
        frame: the frame that follows; the tip by default.
        c1: of (10) at the lower limits, 1/s.
        c2: of (10) at the upper limits, 1/s.

    Returns:
        Formulation in the joint velocity ``u`` (nv,) with parameters ``q``
        (nv,), ``rd_dot`` and ``rd`` (3,).

    Raises:
        RrnnError: kappa, c1 or c2 is not positive.
        RobotError: there is no such frame.

    Source:
        Ours, from what Li, Li, Hannaford (IEEE TII 2019) say of their [35] in
        section II-B and Table I.
    """
    require_positive(kappa=kappa)
    u, rd, task = velocity(kin), target(), tracking(kin, frame)
    lower, upper = velocity_bounds(kin.q, kin.robot.limits, c1=c1, c2=c2)
    if not position_limits:
        fastest = np.asarray(kin.robot.limits.velocity)
        lower, upper = ca.SX(-fastest), ca.SX(fastest)
    error = rd.sx - kin.position(frame)
    return Formulation(
        name="model35",
        decision=u,
        parameters=(task.q, task.rate, rd),
        cost=ca.dot(u.sx, u.sx) / 2,
        equalities=task.rate.sx + kappa * error - task.jacobian @ u.sx,
        lower=lower,
        upper=upper,
        citation=_CITATION,
        notes=_NOTES,
    )
