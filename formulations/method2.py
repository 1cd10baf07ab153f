"""Method 2: acceleration level, minimum acceleration norm, open loop."""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.acceleration_limits import acceleration_bounds
from rrnn_opt.formulations.contacts import Contacts, contacts_of
from rrnn_opt.formulations.signs import (
    Band,
    active,
    magnitudes,
    sign_jacobian,
    threefold,
)
from rrnn_opt.formulations.task import (
    acceleration,
    joint_velocity,
    require_positive,
    target_acceleration,
    tracking,
)
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol

_CITATION = (
    "after D. Guo, Y. Zhang, IEEE Trans. Industrial Electronics 61(12):6903-6914, "
    "2014, doi:10.1109/TIE.2014.2331036, which is Method 2 of Li, Li, Hannaford, "
    "IEEE TII 15(4), 2019"
)
_NOTES = (
    "A reconstruction: the obstacle rows are Method 1's, differentiated by us.  "
    "Neither position nor velocity is fed back, so noise is integrated twice.  The "
    "position term of the bounds is an undamped spring and can be overshot."
)


@checked()
def method2(
    kin: Kinematics,
    *,
    contacts: Sequence[int] = (),
    band: Band = Band(),  # noqa: B008  frozen
    kappa_o: float = 10.0,
    mu_p: float = 20.0,
    mu_v: float = 20.0,
    range_share: float = 0.02,
    frame: str | None = None,
) -> Formulation:
    """Smallest joint acceleration along an open-loop task acceleration.

        minimise    1/2 u'u,   u the joint acceleration
        subject to  rd_ddot - J'(q, qd) qd - J(q) u = 0      (J' = dJ/dt)
                    J_N u <= -J_N' qd + b' - kappa_o (J_N qd - b)
                    u <= min(mu_p (q+ - theta - q), mu_v (w - qd), a)
                    u >= max(mu_p (q- + theta - q), mu_v (-w - qd), -a)

    J_N qd <= b are the sign rows of ``method1``, J_N = -diag(sgn n) J_o, with
    b = s(d) b0 and s falling from ``s(d2) = 1`` to ``s(d1) = 0``; the rows here
    make the excess J_N qd - b die out at the rate kappa_o.  b' = s'(d) n'J_o qd
    b0, and n counts as constant between updates.  The bounds are
    ``acceleration_bounds``: w the largest speed, a the largest acceleration.

    Args:
        kin: kinematics of the robot.
        contacts: index of the robot's sphere in each contact; none: no rows.
        band: d1 and d2 of the variable magnitude, m.
        kappa_o: rate of the obstacle rows, 1/s.
        mu_p: stiffness of the position bound, 1/s2.
        mu_v: rate of the speed bound, 1/s.
        range_share: theta, kept from each position limit, as a share of the joint's
            range.
        frame: the frame that follows; the tip by default.

    Returns:
        Formulation in the joint acceleration ``u`` (nv,) with parameters ``q``
        and ``qd`` (nv,), ``rd_ddot`` (3,) and, with k contacts, ``normals``
        (3, k), ``clearances`` (k,) and ``magnitudes`` (3k,).

    Raises:
        RrnnError: no such sphere; a gain is not positive.
        RobotError: there is no such frame.

    Source:
        Reconstructed: objective, equality and bounds in the standard form of
        D. Guo, Y. Zhang (IEEE TIE 61(12), 2014); the paper's own inequality and
        its gains are not known to us.
    """
    require_positive(kappa_o=kappa_o)
    u, qd, task = acceleration(kin), joint_velocity(kin), tracking(kin, frame)
    wanted, near = target_acceleration(), contacts_of(kin, contacts)
    stored = magnitudes(len(contacts))
    drift = kin.jacobian_dot(frame, qd.sx) @ qd.sx
    lower, upper = acceleration_bounds(
        kin.q, qd.sx, kin.robot.limits, mu_p=mu_p, mu_v=mu_v, range_share=range_share
    )
    return Formulation(
        name="method2",
        decision=u,
        parameters=(
            task.q,
            qd,
            wanted,
            *near.symbols,
            *(stored,) * (len(contacts) > 0),
        ),
        cost=ca.dot(u.sx, u.sx) / 2,
        equalities=wanted.sx - drift - task.jacobian @ u.sx,
        inequalities=_rows(near, task.q, qd, u, stored.sx, band, kappa_o),
        lower=lower,
        upper=upper,
        citation=_CITATION,
        notes=_NOTES,
        level="acceleration",
    )


def _rows(
    near: Contacts,
    q: Symbol,
    qd: Symbol,
    u: Symbol,
    stored: ca.SX,
    band: Band,
    kappa_o: float,
) -> ca.SX | None:
    """d(J_N qd - b)/dt + kappa_o (J_N qd - b) <= 0, off beyond d2, (3k, 1)."""
    if not near.jacobians:
        return None
    J, gaps = sign_jacobian(near), near.clearances.sx
    approach = band.slope(gaps) * (near.gradients @ qd.sx)
    excess = J @ qd.sx - threefold(band.share(gaps)) * stored
    drift = ca.jtimes(J @ qd.sx, q.sx, qd.sx) - threefold(approach) * stored
    return active(near, band.outer) * (J @ u.sx + drift + kappa_o * excess)
