"""Joint position and speed limits as bounds on the joint velocity, eq. (10)."""

from __future__ import annotations

import casadi as ca
import numpy as np

from rrnn_opt.errors import RrnnError
from rrnn_opt.robot import Limits
from rrnn_opt.symbolic import require_shape


def velocity_bounds(
    q: ca.SX, limits: Limits, *, c1: float = 0.5, c2: float = 0.5
) -> tuple[ca.SX, ca.SX]:
    """The box Omega(q) of joint velocities.

        d- = max(-c1 (q - q-), w-),    d+ = min(-c2 (q - q+), w+)      (10)

    with w+ = -w- the largest speed.  A joint without a position limit keeps
    w- and w+ alone.

    For q- <= q <= q+ the box holds 0, so it is not empty, and q' in Omega(q)
    keeps q inside for ever (q+ - q >= (q+ - q(0)) exp(-c2 t)).  A network that
    lets q' lag behind, such as (6a), keeps it inside only when 4 epsilon c <= 1
    and it starts slowly enough.

    Outside the limits 0 is no longer in the box.  While the violation is small
    (q - q+ <= w/c2, and c2 (q - q+) <= c1 (q - q-)) the box holds only
    velocities that lead back; beyond that d- > d+ and it is empty.  Then
    ``qp.at`` raises InfeasibleQpError, and the projection (9) returns d+.

    Args:
        q: joint positions, (nv, 1), rad or m.
        limits: position limits may be infinite; speeds are positive.
        c1: at the lower limit, 1/s.
        c2: at the upper limit, 1/s.

    Returns:
        d- and d+, (nv, 1) each, rad/s or m/s.

    Raises:
        ShapeError: q is no column of the limits' length.
        RrnnError: c1 or c2 is not positive.

    Source:
        Li, Li, Hannaford (IEEE TII 2019), eq. (10); c1 = c2 = 0.5 as there.
    """
    require_shape(q, (len(limits.velocity), 1), "q")
    if not (c1 > 0.0 and c2 > 0.0):
        raise RrnnError(f"limits (10): c1 = {c1} and c2 = {c2} must be positive")
    lower, upper = [], []
    for i, speed in enumerate(limits.velocity):
        low, high = ca.SX(-float(speed)), ca.SX(float(speed))
        if np.isfinite(limits.lower[i]):
            low = ca.fmax(-c1 * (q[i] - float(limits.lower[i])), low)
        if np.isfinite(limits.upper[i]):
            high = ca.fmin(-c2 * (q[i] - float(limits.upper[i])), high)
        lower.append(low)
        upper.append(high)
    return ca.vertcat(*lower), ca.vertcat(*upper)
