"""The model [43] of Table I (stand-in): a damped pseudo-inverse, open loop."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.task import require_positive, tracking, velocity
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic.linear import cholesky_solve

_CITATION = (
    "stand-in for reference [43] of Y. Li, S. Li, B. Hannaford, IEEE Trans. "
    "Industrial Informatics 15(4):2054-2063, 2019, doi:10.1109/TII.2018.2869588"
)
_NOTES = (
    "A stand-in: [43] is not known to us.  It has what Table I says of it: an error "
    "that is not zero, accumulation, a matrix inverse, no limits, no obstacles."
)


@checked()
def model43(
    kin: Kinematics, *, damping: float = 1e-4, frame: str | None = None
) -> Formulation:
    """The damped pseudo-inverse as a programme without rows or bounds.

        minimise    1/2 |u - J'(J J' + damping I)^-1 rd_dot|^2

    The optimum is that velocity itself, the inverse standing written out in
    the linear term.  Following it, the tip moves at J u = rd_dot - damping
    (J J' + damping I)^-1 rd_dot: slower than asked, more so near singular
    postures, and nothing measures the difference.

    Args:
        kin: kinematics of the robot.
        damping: m2; without it the inverse would not exist at singular postures.
        frame: the frame that follows; the tip by default.

    Returns:
        Formulation in the joint velocity ``u`` (nv,) with parameters ``q``
        (nv,) and ``rd_dot`` (3,).

    Raises:
        RrnnError: damping is not positive.
        RobotError: there is no such frame.

    Source:
        Ours, from what Table I of Li, Li, Hannaford (IEEE TII 2019) says of
        [43], which is all that the paper says of it.
    """
    require_positive(damping=damping)
    u, task = velocity(kin), tracking(kin, frame)
    J = task.jacobian
    wish = J.T @ cholesky_solve(J @ J.T + damping * ca.SX.eye(3), task.rate.sx)
    return Formulation(
        name="model43",
        decision=u,
        parameters=(task.q, task.rate),
        cost=ca.dot(u.sx, u.sx) / 2 - ca.dot(wish, u.sx),
        citation=_CITATION,
        notes=_NOTES,
        inverse="J J' + damping I",
    )
