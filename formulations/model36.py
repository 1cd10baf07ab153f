"""The model [36] of Table I (stand-in): regulation with clamped speeds."""

from __future__ import annotations

from dataclasses import replace

from rrnn_opt.arguments import checked
from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.formulations.task import positions, regulation_cost, target, velocity
from rrnn_opt.robot import Kinematics

_CITATION = (
    "stand-in for reference [36] of Y. Li, S. Li, B. Hannaford, IEEE Trans. "
    "Industrial Informatics 15(4):2054-2063, 2019, doi:10.1109/TII.2018.2869588"
)
_NOTES = (
    "A stand-in: which publication [36] is, is not settled.  The paper cites it for "
    "the error in the target and for clamping the speed, and both stand here."
)


@checked()
def model36(
    kin: Kinematics,
    *,
    epsilon: float = 0.01,
    speed: float = 0.5,
    frame: str | None = None,
    c1: float = 0.5,
    c2: float = 0.5,
) -> Formulation:
    """Position feedback (17) with w+- of (10) clamped below the largest speeds.

        minimise    1/2 u'u - (1/epsilon) e'J(q) u,    e = rd - r(q)
        subject to  max(-c1 (q - q-), -speed w) <= u <= min(-c2 (q - q+), speed w)

    speed = 1 would be ``position_feedback``.  Far from the target all joints
    run at the clamp, which shapes the motion; near it the law is (17).

    Args:
        kin: kinematics of the robot.
        epsilon: inverse of the feedback gain, s, as in ``position_feedback``.
        speed: share of the largest joint speeds w, in (0, 1].
        frame: the frame that goes; the tip by default.
        c1: of (10) at the lower limits, 1/s.
        c2: of (10) at the upper limits, 1/s.

    Returns:
        Formulation in the joint velocity ``u`` (nv,) with parameters ``q``
        (nv,) and ``rd`` (3,).

    Raises:
        RrnnError: epsilon, c1 or c2 is not positive; speed not in (0, 1].
        RobotError: there is no such frame.

    Source:
        Ours, from what Li, Li, Hannaford (IEEE TII 2019) say of their [36] in
        section II-B.
    """
    if not 0.0 < speed <= 1.0:
        raise RrnnError(f"speed {speed}: it must be a share in (0, 1]")
    u, rd, limits = velocity(kin), target(), kin.robot.limits
    clamped = replace(limits, velocity=speed * limits.velocity)
    lower, upper = velocity_bounds(kin.q, clamped, c1=c1, c2=c2)
    return Formulation(
        name="model36",
        decision=u,
        parameters=(positions(kin), rd),
        cost=regulation_cost(kin, u, rd, frame=frame, epsilon=epsilon),
        lower=lower,
        upper=upper,
        citation=_CITATION,
        notes=_NOTES,
    )
