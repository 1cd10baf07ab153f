"""Infinity norm: the fastest joint as slow as possible."""

from __future__ import annotations

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from rrnn_opt.arguments import checked
from rrnn_opt.errors import RrnnError, ShapeError
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.formulations.task import POSITION, require_positive, tracking
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol

_CITATION = (
    "A. Deo, I. Walker, IEEE Trans. Robotics and Automation 13(5):767-775, 1997; "
    "with a second norm beside it: Y. Zhang, J. Wang, Y. Xu, IEEE Trans. Robotics "
    "and Automation 18(6):923-931, 2002"
)
_NOTES = (
    "t^2 in place of t, and a small ridge: the minimum of the largest entry alone is "
    "a linear programme, often not unique, and jumps as the posture changes."
)


@checked()
def infinity_norm(
    kin: Kinematics,
    *,
    ridge: float = 1e-3,
    scale: ArrayLike | None = None,
    task: str = POSITION,
    frame: str | None = None,
    c1: float = 0.5,
    c2: float = 0.5,
) -> Formulation:
    """Follow a task velocity with the smallest largest joint speed.

        minimise    1/2 t^2 + ridge/2 u'u
        subject to  rd_dot - J(q) u = 0
                    -t <= u_j / scale_j <= t
                    d-(q) <= u <= d+(q)                            (10)

    t exceeds the least possible by a share of at most ridge |scale|^2 / 2.

    Args:
        kin: kinematics of the robot.
        ridge: weight of the second norm, s2/rad2 when t has no unit, else 1.
        scale: what a joint's speed is measured by, (nv,) positive; 1 for each
            by default, the classical norm.  Give the largest speeds for arms
            that have both turning and sliding joints: t then is a share.
        task: "position" or "pose", as in ``minimum_velocity``.
        frame: the frame that follows; the tip by default.
        c1: of (10) at the lower limits, 1/s.
        c2: of (10) at the upper limits, 1/s.

    Returns:
        Formulation in ``u`` (nv + 1,), the joint velocity and then t, with
        parameters ``q`` (nv,) and ``rd_dot`` (3,) or (6,).

    Raises:
        ShapeError: scale has the wrong shape.
        RrnnError: ridge, c1, c2 or a scale is not positive; no such task.
        RobotError: there is no such frame.

    Source:
        Deo and Walker 1997; the mixed cost after Zhang, Wang, Xu 2002, with
        weights of our own.
    """
    require_positive(ridge=ridge)
    nv, wanted = kin.robot.nv, tracking(kin, frame, task)
    sizes = np.ones(nv) if scale is None else np.asarray(scale, dtype=np.float64)
    if sizes.shape != (nv,):
        raise ShapeError("scale", (nv,), sizes.shape)
    if not np.all((sizes > 0.0) & np.isfinite(sizes)):
        raise RrnnError("scale: every number must be positive and finite")
    both = Symbol.vector("u", nv + 1, "rad/s or m/s", "joint velocity, then t")
    u, t = both.sx[:nv], both.sx[nv]
    lower, upper = velocity_bounds(kin.q, kin.robot.limits, c1=c1, c2=c2)
    share = u / ca.SX(sizes)
    return Formulation(
        name="infinity_norm",
        decision=both,
        parameters=(wanted.q, wanted.rate),
        cost=t * t / 2 + ridge / 2 * ca.dot(u, u),
        equalities=wanted.rate.sx - wanted.jacobian @ u,
        inequalities=ca.vertcat(share - t, -share - t),
        lower=ca.vertcat(lower, -ca.inf),
        upper=ca.vertcat(upper, ca.inf),
        citation=_CITATION,
        notes=_NOTES,
    )
