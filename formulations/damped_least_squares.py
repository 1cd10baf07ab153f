"""Damped least squares: exact far from singular postures, damped near them."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.manipulability import gram_determinant
from rrnn_opt.formulations.task import require_positive, tracking
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol

_CITATION = (
    "Y. Nakamura, H. Hanafusa, ASME J. Dynamic Systems, Measurement, and Control "
    "108(3):163-171, 1986, doi:10.1115/1.3143764; C. Wampler, IEEE Trans. Systems, "
    "Man, and Cybernetics 16(1):93-101, 1986, doi:10.1109/TSMC.1986.289285"
)
_NOTES = (
    "No limits, as in the sources; slack_task has them.  The threshold belongs to "
    "the robot: compare it with the measure w of its usual postures."
)


@checked()
def damped_least_squares(
    kin: Kinematics,
    *,
    damping: float = 0.1,
    threshold: float = 0.02,
    frame: str | None = None,
) -> Formulation:
    """Follow a task velocity, giving way near singular postures only.

        minimise    1/2 u'u + 1/2 s's
        subject to  rd_dot - J(q) u - delta(q) s = 0

        delta = damping max(1 - w / threshold, 0),   w = sqrt(det(J J'))

    Its optimum is u = J'(J J' + delta^2 I)^-1 rd_dot.  The damping changes
    with the posture while the Hessian, I, does not: the slack is scaled, not
    its weight.  A constant delta would be ``slack_task`` without its limits.
    At w >= threshold the task is met exactly; the programme is feasible there,
    J having full rank, if rd_dot asks for nothing that the arm can never do.

    Args:
        kin: kinematics of the robot.
        damping: delta at a singular posture, m.
        threshold: measure w below which damping begins; m3, or m2 for a
            planar arm.
        frame: the frame that follows; the tip by default.

    Returns:
        Formulation in ``u`` (nv + 3,), the joint velocity and then s, with
        parameters ``q`` (nv,) and ``rd_dot`` (3,).

    Raises:
        RrnnError: damping or threshold is not positive.
        RobotError: there is no such frame.

    Source:
        Nakamura and Hanafusa 1986, whose factor is delta^2 itself:
        delta^2 = damping^2 (1 - w / threshold)^2; the QP is ours.
    """
    require_positive(damping=damping, threshold=threshold)
    nv, task = kin.robot.nv, tracking(kin, frame)
    both = Symbol.vector("u", nv + 3, "rad/s or m/s", "joint velocity, then slack")
    w = ca.sqrt(ca.fmax(gram_determinant(kin, frame), 0))
    delta = damping * ca.fmax(1 - w / threshold, 0)
    done = task.jacobian @ both.sx[:nv] + delta * both.sx[nv:]
    return Formulation(
        name="damped_least_squares",
        decision=both,
        parameters=(task.q, task.rate),
        cost=ca.dot(both.sx, both.sx) / 2,
        equalities=task.rate.sx - done,
        citation=_CITATION,
        notes=_NOTES,
    )
