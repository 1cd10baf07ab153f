"""Position feedback, eq. (17), as the box QP whose network it is."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.formulations.task import require_positive, target, tracking, velocity
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic.linear import cholesky_solve

_CITATION = (
    "Y. Li, S. Li, B. Hannaford, IEEE Trans. Industrial Informatics "
    "15(4):2054-2063, 2019, doi:10.1109/TII.2018.2869588, eqs. (10), (17)"
)
_NOTES = (
    "(17) does not follow from (7): k e'e has no derivative with respect to the "
    "joint velocity.  It is (6a) on this box QP, or (6) with e/epsilon measured "
    "in place of an integrated lambda.  A moving target leaves a lag; an active "
    "joint limit can stop it short of a reachable target."
)
_FORWARD = (
    "(17) with a feed-forward of our own, which removes the lag behind a moving "
    "target and inverts J J'; the paper has neither."
)


@checked()
def position_feedback(
    kin: Kinematics,
    *,
    epsilon: float = 0.01,
    feed_forward: bool = False,
    damping: float = 1e-6,
    frame: str | None = None,
    c1: float = 0.5,
    c2: float = 0.5,
) -> Formulation:
    """Go towards a target position by feedback of the error.

        minimise    1/2 u'u - (1/epsilon) e'J(q) u,    e = rd - position(q)
        subject to  d-(q) <= u <= d+(q)                            (10)

    Its optimum is u = P_Omega(J'e/epsilon), the reduced law (18), and its
    network ``PrimalDual(epsilon)`` is exactly

        epsilon u' = -u + P_Omega(J' (1/epsilon) (rd - r)).        (17)

    A target that moves at rd_dot is followed at a distance e of about
    epsilon (J J')^-1 rd_dot, since J u = rd_dot needs J J'e/epsilon = rd_dot.
    ``feed_forward`` gives the drive that velocity beforehand,

        P_Omega(J' (e/epsilon + (J J' + damping I)^-1 rd_dot)),

    so that e' = -J J'e/epsilon: no lag.  The same optimum could be had free of
    inversion from the row J (u - J'e/epsilon) = rd_dot, but that row has no
    solution as soon as the pull J'e/epsilon saturates, on which (17) relies
    whenever the target is far; the box alone always has one.

    Args:
        kin: kinematics of the robot.
        epsilon: inverse of the feedback gain, s; (17) has this same number as
            the network's time constant, so give ``PrimalDual`` the same.
        feed_forward: add the parameter rd_dot; not in the paper.
        damping: of the feed-forward, m2; it leaves the share
            damping / (sigma^2 + damping) of the lag along a singular value
            sigma of J.
        frame: the frame that goes; the tip by default.
        c1: of (10) at the lower limits, 1/s.
        c2: of (10) at the upper limits, 1/s.

    Returns:
        Formulation in the joint velocity ``u`` (nv,) with parameters ``q``
        (nv,), ``rd`` (3,) and, fed forward, ``rd_dot`` (3,); its name then is
        "position_feedback_feed_forward".

    Raises:
        RrnnError: epsilon, damping, c1 or c2 is not positive.
        RobotError: there is no such frame.

    Source:
        Li, Li, Hannaford (IEEE TII 2019), eqs. (10), (17); the box QP and the
        feed-forward are ours.
    """
    require_positive(epsilon=epsilon, damping=damping)
    u, rd, task = velocity(kin), target(), tracking(kin, frame)
    J, pull = task.jacobian, (rd.sx - kin.position(frame)) / epsilon
    if feed_forward:
        gram = J @ J.T + damping * ca.SX.eye(3)
        pull = pull + cholesky_solve(gram, task.rate.sx)
    lower, upper = velocity_bounds(kin.q, kin.robot.limits, c1=c1, c2=c2)
    return Formulation(
        name="position_feedback" + "_feed_forward" * feed_forward,
        decision=u,
        parameters=(task.q, rd, *(task.rate,) * feed_forward),
        cost=ca.dot(u.sx, u.sx) / 2 - ca.dot(J.T @ pull, u.sx),
        lower=lower,
        upper=upper,
        citation=_CITATION,
        notes=_FORWARD if feed_forward else _NOTES,
        inverse="J J' + damping I" * feed_forward,
    )
