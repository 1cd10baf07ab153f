"""Method 3 (stand-in): a noise-tolerant scheme with integral action, no limits."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.task import require_positive, target, tracking, velocity
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol

_CITATION = (
    "stand-in for Method 3 of Li, Li, Hannaford, IEEE TII 15(4), 2019; integral "
    "action as in noise-tolerant zeroing networks: L. Jin, Y. Zhang, S. Li, "
    "Y. Zhang, IEEE Trans. Industrial Electronics 63(11):6978-6988, 2016"
)
_NOTES = (
    "A stand-in, not the published network, whose equations we do not have.  It has "
    "what the paper's table says of it: zero error, no accumulation, no inversion, no "
    "limits, no obstacles.  e_int is a state of the loop."
)


@checked()
def method3(
    kin: Kinematics,
    *,
    k0: float = 20.0,
    k1: float = 100.0,
    frame: str | None = None,
) -> Formulation:
    """Follow a target with proportional and integral feedback, free of limits.

        minimise    1/2 u'u
        subject to  rd_dot + k0 e + k1 e_int - J(q) u = 0,
                    e = rd - r(q),   e_int = integral of e

    The error obeys e' = -k0 e - k1 e_int: a constant disturbance of the joint
    velocity leaves no error behind, which ``closed_loop`` (k1 = 0) does not
    achieve.  The default k1 = k0^2 / 4 puts both poles at -k0 / 2.

    Args:
        kin: kinematics of the robot.
        k0: proportional gain, 1/s.
        k1: integral gain, 1/s2.
        frame: the frame that follows; the tip by default.

    Returns:
        Formulation in the joint velocity ``u`` (nv,), without bounds, with
        parameters ``q`` (nv,), ``rd_dot``, ``rd`` and ``e_int`` (3,).

    Raises:
        RrnnError: a gain is not positive.
        RobotError: there is no such frame.

    Source:
        Ours, in the place of reference [44] of Li, Li, Hannaford (IEEE TII
        2019), of which the paper gives no formula; integral action as in L. Jin,
        Y. Zhang, S. Li, Y. Zhang (IEEE TIE 63(11), 2016).
    """
    require_positive(k0=k0, k1=k1)
    u, rd, task = velocity(kin), target(), tracking(kin, frame)
    total = Symbol.vector("e_int", 3, "m s", "integral of the position error")
    feedback = k0 * (rd.sx - kin.position(frame)) + k1 * total.sx
    return Formulation(
        name="method3",
        decision=u,
        parameters=(task.q, task.rate, rd, total),
        cost=ca.dot(u.sx, u.sx) / 2,
        equalities=task.rate.sx + feedback - task.jacobian @ u.sx,
        citation=_CITATION,
        notes=_NOTES,
    )
