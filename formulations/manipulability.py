"""Manipulability: self-motion away from singular postures."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.formulations.task import follow, require_positive, tracking
from rrnn_opt.robot import Kinematics

_CITATION = (
    "T. Yoshikawa, Int. J. Robotics Research 4(2):3-9, 1985, "
    "doi:10.1177/027836498500400201; as a network: L. Jin, S. Li, H. M. La, X. Luo, "
    "IEEE Trans. Industrial Electronics 64(6):4710-4720, 2017"
)
_NOTES = (
    "Ascent of the measure itself, not of its rate as an inequality; of the position "
    "rows in which the arm can move.  The measure divides by a scalar that the floor "
    "keeps positive; no matrix is inverted."
)


def gram_determinant(kin: Kinematics, frame: str | None = None) -> ca.SX:
    """``w^2 = det(J J')`` of the position rows that can move, w Yoshikawa's measure.

    Args:
        kin: kinematics of the robot.
        frame: the frame; the tip by default.

    Returns:
        (1, 1), m to the power of twice the number of rows; rounding may make
        it negative near 0.  det(J'J) with fewer joints than rows.

    Raises:
        RobotError: there is no such frame.
    """
    J = kin.jacobian(frame)
    J = J[[i for i in range(3) if not J[i, :].is_zero()], :]
    return ca.det(J @ J.T if J.size1() <= J.size2() else J.T @ J)


@checked()
def manipulability(
    kin: Kinematics,
    *,
    gain: float = 1.0,
    floor: float = 1e-3,
    frame: str | None = None,
    c1: float = 0.5,
    c2: float = 0.5,
) -> Formulation:
    """Follow a task velocity, self-motion raising the manipulability.

        minimise    1/2 |u - gain grad w(q)|^2,   w = sqrt(det(J J') + floor^2)
        subject to  rd_dot - J(q) u = 0
                    d-(q) <= u <= d+(q)                            (10)

    Args:
        kin: kinematics of the robot.
        gain: of the ascent of w, rad2/s over the unit of w.
        floor: keeps the gradient finite at singular postures; unit of w (m3,
            or m2 for a planar arm).
        frame: the frame that follows; the tip by default.
        c1: of (10) at the lower limits, 1/s.
        c2: of (10) at the upper limits, 1/s.

    Returns:
        Formulation in the joint velocity ``u`` (nv,) with parameters ``q``
        (nv,) and ``rd_dot`` (3,).

    Raises:
        RrnnError: gain, floor, c1 or c2 is not positive.
        RobotError: there is no such frame.

    Source:
        Yoshikawa 1985 for w; the floor is ours.  Jin et al. 2017 maximise
        differently, and their programme is not reconstructed here.
    """
    require_positive(gain=gain, floor=floor)
    square = gram_determinant(kin, frame)
    w = ca.sqrt(ca.fmax(square, 0) + floor**2)
    return follow(
        kin,
        tracking(kin, frame),
        name="manipulability",
        wish=gain * ca.gradient(square, kin.q) / (2 * w),
        bounds=velocity_bounds(kin.q, kin.robot.limits, c1=c1, c2=c2),
        citation=_CITATION,
        notes=_NOTES,
    )
