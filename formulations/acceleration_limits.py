"""Joint limits as bounds on the joint acceleration."""

from __future__ import annotations

from collections.abc import Callable

import casadi as ca
import numpy as np

from rrnn_opt.errors import RrnnError
from rrnn_opt.robot import Limits
from rrnn_opt.symbolic import require_shape


def acceleration_bounds(
    q: ca.SX,
    qd: ca.SX,
    limits: Limits,
    *,
    mu_p: float = 20.0,
    mu_v: float = 20.0,
    range_share: float = 0.02,
) -> tuple[ca.SX, ca.SX]:
    """Position, speed and acceleration limits as bounds on the acceleration.

        u+ = min(mu_p (q+ - theta - q), mu_v (w - qd), a)
        u- = max(mu_p (q- + theta - q), mu_v (-w - qd), -a)

    Within the limits (less theta) the box holds 0.  Its first term is a spring
    without damping: a joint that arrives with speed v overshoots by up to
    v / sqrt(mu_p), for which theta is kept.  ``braking_bounds`` does not.

    Args:
        q: joint positions, (nv, 1), rad or m.
        qd: joint velocities, (nv, 1), rad/s or m/s.
        limits: position limits may be infinite.
        mu_p: stiffness, 1/s2.
        mu_v: rate, 1/s.
        range_share: theta as a share of the joint's range, in [0, 1/2).

    Returns:
        u- and u+, (nv, 1) each, rad/s2 or m/s2.

    Raises:
        ShapeError: q or qd is no column of the limits' length.
        RrnnError: a gain is not positive, or range_share not in [0, 1/2).

    Source:
        The three-term bound of Guo and Zhang's acceleration-level schemes
        (IEEE TIE 61(12), 2014); mu_p, mu_v and theta are our choice.
    """
    if not (mu_p > 0.0 and mu_v > 0.0 and 0.0 <= range_share < 0.5):
        raise RrnnError(
            f"acceleration bounds: mu_p = {mu_p} and mu_v = {mu_v} must be "
            f"positive, range_share = {range_share} in [0, 1/2)"
        )

    def pull(i: int, limit: float, inwards: float) -> ca.SX:
        span = float(limits.upper[i] - limits.lower[i])
        theta = range_share * span if np.isfinite(span) else 0.0
        return mu_p * (limit + inwards * theta - q[i])

    return _three_terms(q, qd, limits, mu_v, pull)


def braking_bounds(
    q: ca.SX,
    qd: ca.SX,
    limits: Limits,
    *,
    mu_v: float = 20.0,
) -> tuple[ca.SX, ca.SX]:
    """Acceleration bounds that keep position and speed inside for ever.

        u+ = min(omega^2 (q+ - q) - 2 omega qd, mu_v (w - qd), a),  omega = a/w

    and its mirror image.  z = omega (q+ - q) - qd obeys z' >= -omega z, so a
    motion that starts with |qd| <= w and -omega (q - q-) <= qd <= omega
    (q+ - q) keeps to both; there the box is never empty, as omega w <= a and
    omega <= 2 mu_v.

    Args:
        q: joint positions, (nv, 1), rad or m.
        qd: joint velocities, (nv, 1), rad/s or m/s.
        limits: position limits may be infinite.
        mu_v: rate of the speed bound, 1/s; at least omega / 2.

    Returns:
        u- and u+, (nv, 1) each, rad/s2 or m/s2.

    Raises:
        ShapeError: q or qd is no column of the limits' length.
        RrnnError: mu_v is too small.

    Source:
        Ours, as an exponential control barrier (Q. Nguyen, K. Sreenath,
        American Control Conference 2016) with both poles at -omega.
    """
    omega = np.asarray(limits.acceleration) / np.asarray(limits.velocity)
    if not 2.0 * mu_v >= omega.max():
        raise RrnnError(f"mu_v = {mu_v}: it must be at least {omega.max() / 2:g} 1/s")

    def pull(i: int, limit: float, inwards: float) -> ca.SX:
        w = float(omega[i])
        return w * w * (limit - q[i]) - 2 * w * qd[i]

    return _three_terms(q, qd, limits, mu_v, pull)


def _three_terms(
    q: ca.SX,
    qd: ca.SX,
    limits: Limits,
    mu_v: float,
    pull: Callable[[int, float, float], ca.SX],
) -> tuple[ca.SX, ca.SX]:
    """Position term (limit, direction inwards), speed term, largest acceleration."""
    n = len(limits.velocity)
    require_shape(q, (n, 1), "q")
    require_shape(qd, (n, 1), "qd")
    lower, upper = [], []
    for i in range(n):
        speed, most = float(limits.velocity[i]), float(limits.acceleration[i])
        low = ca.fmax(mu_v * (-speed - qd[i]), -most)
        high = ca.fmin(mu_v * (speed - qd[i]), most)
        if np.isfinite(limits.lower[i]):
            low = ca.fmax(pull(i, float(limits.lower[i]), 1.0), low)
        if np.isfinite(limits.upper[i]):
            high = ca.fmin(pull(i, float(limits.upper[i]), -1.0), high)
        lower.append(low)
        upper.append(high)
    return ca.vertcat(*lower), ca.vertcat(*upper)
