"""Repetitive motion: a closed curve of the tip brings the joints back too."""

from __future__ import annotations

from rrnn_opt.arguments import checked
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.formulations.task import POSITION, follow, require_positive, tracking
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol

_CITATION = (
    "Y. Zhang, X. Lv, Z. Li, Z. Yang, K. Chen, Mechatronics 18(9):475-485, 2008; "
    "limits (10) of Li, Li, Hannaford, IEEE TII 15(4), 2019"
)
_NOTES = (
    "Drift is small, not zero: after a closed curve the joints are back to within a "
    "distance that falls with the gain and does not grow from lap to lap.  In steps "
    "of h seconds keep h gain < 1."
)


@checked()
def repetitive_motion(
    kin: Kinematics,
    *,
    gain: float = 4.0,
    task: str = POSITION,
    frame: str | None = None,
    c1: float = 0.5,
    c2: float = 0.5,
) -> Formulation:
    """Follow a task velocity while staying near the posture of the start.

        minimise    1/2 |u + gain (q - q_start)|^2
        subject to  rd_dot - J(q) u = 0
                    d-(q) <= u <= d+(q)                            (10)

    ``minimum_velocity`` (gain = 0) lets the posture drift while the tip runs
    round a closed curve; here self-motion goes back at the rate ``gain``.

    Args:
        kin: kinematics of the robot.
        gain: 1/s.
        task: "position" or "pose", as in ``minimum_velocity``.
        frame: the frame that follows; the tip by default.
        c1: of (10) at the lower limits, 1/s.
        c2: of (10) at the upper limits, 1/s.

    Returns:
        Formulation in the joint velocity ``u`` (nv,) with parameters ``q``
        (nv,), ``rd_dot`` (3,) or (6,) and ``q_start`` (nv,).

    Raises:
        RrnnError: gain, c1 or c2 is not positive; no such task.
        RobotError: there is no such frame.

    Source:
        Zhang et al. 2008, with the limits (10) of Li, Li, Hannaford (IEEE TII
        2019), which have the same form.
    """
    require_positive(gain=gain)
    meaning = "joint positions at the start"
    start = Symbol.vector("q_start", kin.robot.nv, "rad or m", meaning)
    return follow(
        kin,
        tracking(kin, frame, task),
        name="repetitive_motion",
        wish=-gain * (kin.q - start.sx),
        parameters=(start,),
        bounds=velocity_bounds(kin.q, kin.robot.limits, c1=c1, c2=c2),
        citation=_CITATION,
        notes=_NOTES,
    )
