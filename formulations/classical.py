"""The classical law (15)-(16): an integrated multiplier, no measured position."""

from __future__ import annotations

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.formulation import Formulation
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.formulations.task import tracking, velocity
from rrnn_opt.robot import Kinematics
from rrnn_opt.symbolic import Symbol, require_shape

_CITATION = (
    "Y. Li, S. Li, B. Hannaford, IEEE Trans. Industrial Informatics "
    "15(4):2054-2063, 2019, doi:10.1109/TII.2018.2869588, eqs. (6), (15), (16)"
)
_NOTES = (
    "lam is a state of the loop, integrated by multiplier_rate from what was "
    "commanded.  Errors do not grow by themselves: epsilon lam - e is constant, so "
    "a first error stays as it is.  What accumulates is noise that the command does "
    "not know of.  The paper writes r_d0 with a dot, which is a slip."
)


@checked()
def classical(
    kin: Kinematics,
    *,
    frame: str | None = None,
    c1: float = 0.5,
    c2: float = 0.5,
) -> Formulation:
    """Push the joints by a multiplier that the loop has integrated.

        minimise    1/2 u'u - lam'J(q) u
        subject to  d-(q) <= u <= d+(q)                            (10)

    Its optimum is P_Omega(J'lam), and its network (6a) is

        epsilon u' = -u + P_Omega(J'lam),                          (16)
        epsilon lam' = rd_dot - J u.                               (6b), (15)

    Together that is ``PrimalDual`` of ``minimum_velocity`` with W = I/2, taken
    apart so that the integration can be seen, and changed.  Two loops:
    *commanded* (the classical one) integrates ``multiplier_rate`` of the
    network's own output; *measured* sets lam = lam0 + (rd - rd0 - (r - r0)) /
    epsilon from the true position, the second line of (15).  They agree only
    as long as the arm does exactly what it is told; with lam0 = e0 / epsilon
    the measured loop is (17).

    Args:
        kin: kinematics of the robot.
        frame: the frame that follows; the tip by default.
        c1: of (10) at the lower limits, 1/s.
        c2: of (10) at the upper limits, 1/s.

    Returns:
        Formulation in the joint velocity ``u`` (nv,) with parameters ``q``
        (nv,) and ``lam`` (3,).  The velocity rd_dot enters through lam alone.

    Raises:
        RrnnError: c1 or c2 is not positive.
        RobotError: there is no such frame.

    Source:
        Li, Li, Hannaford (IEEE TII 2019), eqs. (6), (15), (16); the box QP is
        ours.
    """
    u, task = velocity(kin), tracking(kin, frame)
    lam = Symbol.vector("lam", 3, "rad2/(m s)", "multiplier integrated by the loop")
    lower, upper = velocity_bounds(kin.q, kin.robot.limits, c1=c1, c2=c2)
    return Formulation(
        name="classical",
        decision=u,
        parameters=(task.q, lam),
        cost=ca.dot(u.sx, u.sx) / 2 - ca.dot(task.jacobian.T @ lam.sx, u.sx),
        lower=lower,
        upper=upper,
        citation=_CITATION,
        notes=_NOTES,
    )


def multiplier_rate(jacobian: ca.SX, u: ca.SX, rd_dot: ca.SX, epsilon: float) -> ca.SX:
    """Rate of the integrated multiplier, ``lam' = (rd_dot - J u) / epsilon``.

    Args:
        jacobian: J, (3, nv).
        u: commanded joint velocity for the classical law; the velocity that
            was really done for the measured one, (nv, 1).
        rd_dot: desired velocity, (3, 1), m/s.
        epsilon: time constant of the network, s.

    Returns:
        lam', (3, 1).
    """
    require_shape(rd_dot, (3, 1), "rd_dot")
    return (rd_dot - jacobian @ u) / epsilon
