"""Minimum joint velocity under an exact task velocity, eqs. (3) and (10)."""

from __future__ import annotations

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from rrnn_opt.arguments import checked
from rrnn_opt.errors import NotFiniteError, RrnnError, ShapeError
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.formulations.task import POSITION, tracking, velocity
from rrnn_opt.robot import Kinematics

_CITATION = (
    "Y. Li, S. Li, B. Hannaford, IEEE Trans. Industrial Informatics "
    "15(4):2054-2063, 2019, doi:10.1109/TII.2018.2869588, eqs. (3), (10)"
)
_NOTES = (
    "W = I/2 by default: only then is u - dL/du the drive J'lambda of (16).  "
    "The optimum is unique when W is positive definite on the kernel of J."
)


@checked()
def minimum_velocity(
    kin: Kinematics,
    *,
    W: ArrayLike | None = None,
    c: ArrayLike | None = None,
    frame: str | None = None,
    task: str = POSITION,
    c1: float = 0.5,
    c2: float = 0.5,
) -> Formulation:
    """Follow a task velocity with the smallest joint velocity.

        minimise    u'W u + c'u
        subject to  rd_dot - J(q) u = 0
                    d-(q) <= u <= d+(q)                            (10)

    Args:
        kin: kinematics of the robot.
        W: symmetric positive semidefinite weight, (nv, nv), 1; I/2 by default.
        c: linear weight, (nv,), rad/s or m/s; 0 by default.
        frame: the frame that follows; the tip by default.
        task: "position": rd_dot is the velocity of the frame's origin, (3,),
            m/s; "pose": linear then angular velocity, (6,), m/s and rad/s.
        c1: of (10) at the lower limits, 1/s.
        c2: of (10) at the upper limits, 1/s.

    Returns:
        Formulation in the joint velocity ``u`` (nv,) with parameters ``q``
        (nv,) and ``rd_dot`` (3,) or (6,).  The multiplier of its rows is the lambda
        of (4).

    Raises:
        ShapeError: W or c has the wrong shape.
        NotFiniteError: W or c holds NaN or an infinity.
        RrnnError: W is not symmetric; c1 or c2 is not positive; no such task.
        NotAQpError: W is not positive semidefinite.
        RobotError: there is no such frame.

    Source:
        Li, Li, Hannaford (IEEE TII 2019), eqs. (3), (10), its multiplier being
        that of (4).  The paper asks of W only symmetry; semidefiniteness is
        needed for (5) to be an optimum, definiteness for the network (6) to
        reach it.
    """
    u, wanted = velocity(kin), tracking(kin, frame, task)
    lower, upper = velocity_bounds(kin.q, kin.robot.limits, c1=c1, c2=c2)
    return Formulation(
        name="minimum_velocity",
        decision=u,
        parameters=(wanted.q, wanted.rate),
        cost=_cost(u.sx, W, c),
        equalities=wanted.rate.sx - wanted.jacobian @ u.sx,
        lower=lower,
        upper=upper,
        citation=_CITATION,
        notes=_NOTES,
    )


def _cost(u: ca.SX, W: ArrayLike | None, c: ArrayLike | None) -> ca.SX:
    n = u.size1()
    weight = np.eye(n) / 2 if W is None else _numbers(W, (n, n), "W")
    if not np.array_equal(weight, weight.T):
        raise RrnnError("W: it must be symmetric; give (W + W') / 2")
    cost = ca.bilin(ca.SX(ca.sparsify(ca.DM(weight))), u, u)
    if c is None:
        return cost
    return cost + ca.dot(ca.SX(_numbers(c, (n,), "c")), u)


def _numbers(
    value: ArrayLike, shape: tuple[int, ...], name: str
) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    array = np.asarray(value, dtype=np.float64)
    if array.shape != shape:
        raise ShapeError(name, shape, array.shape)
    if not np.all(np.isfinite(array)):
        raise NotFiniteError(name)
    return array
