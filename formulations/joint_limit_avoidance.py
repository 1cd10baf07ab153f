"""Joint-limit avoidance: self-motion towards the middle of the joints' ranges."""

from __future__ import annotations

import casadi as ca
import numpy as np

from rrnn_opt.arguments import checked
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.formulations.task import POSITION, follow, require_positive, tracking
from rrnn_opt.robot import Kinematics

_CITATION = (
    "A. Liegeois, IEEE Trans. Systems, Man, and Cybernetics 7(12):868-871, 1977, "
    "doi:10.1109/TSMC.1977.4309644"
)
_NOTES = (
    "The bounds (10) keep the limits; the wish only keeps away from them, as far as "
    "the task leaves room.  Joints without limits, or without a range, have no wish."
)


@checked()
def joint_limit_avoidance(
    kin: Kinematics,
    *,
    gain: float = 1.0,
    task: str = POSITION,
    frame: str | None = None,
    c1: float = 0.5,
    c2: float = 0.5,
) -> Formulation:
    """Follow a task velocity, self-motion going to the middle of the ranges.

        minimise    1/2 |u + gain grad H(q)|^2
        subject to  rd_dot - J(q) u = 0
                    d-(q) <= u <= d+(q)                            (10)

        H = 1/2 sum_j ((q_j - m_j) / h_j)^2,   m = (q+ + q-)/2,  h = (q+ - q-)/2

    Args:
        kin: kinematics of the robot.
        gain: of the descent of H, rad2/s or m2/s.
        task: "position" or "pose", as in ``minimum_velocity``.
        frame: the frame that follows; the tip by default.
        c1: of (10) at the lower limits, 1/s.
        c2: of (10) at the upper limits, 1/s.

    Returns:
        Formulation in the joint velocity ``u`` (nv,) with parameters ``q``
        (nv,) and ``rd_dot`` (3,) or (6,).

    Raises:
        RrnnError: gain, c1 or c2 is not positive; no such task.
        RobotError: there is no such frame.

    Source:
        Liegeois 1977, whose H is the mean over the joints, not half the sum;
        the bounds are ours.
    """
    require_positive(gain=gain)
    limits = kin.robot.limits
    ends = np.isfinite(limits.lower) & np.isfinite(limits.upper)
    finite = ends & (limits.upper > limits.lower)
    low = np.where(finite, limits.lower, 0.0)
    high = np.where(finite, limits.upper, 0.0)
    half = np.where(finite, (high - low) / 2, np.inf)
    descent = -(kin.q - ca.SX((low + high) / 2)) * ca.SX(1 / half**2)
    return follow(
        kin,
        tracking(kin, frame, task),
        name="joint_limit_avoidance",
        wish=gain * descent,
        bounds=velocity_bounds(kin.q, limits, c1=c1, c2=c2),
        citation=_CITATION,
        notes=_NOTES,
    )
