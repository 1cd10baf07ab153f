"""Cubic Hermite pieces between rows of (q, qd), and their exact extremes.

Between rows i and i+1, with s = t - t_i and h = t_{i+1} - t_i,

    q(s) = c0 + c1 s + c2 s^2 + c3 s^3,
    c0 = q_i,  c1 = qd_i,
    c2 = (3 D - 2 qd_i - qd_{i+1}) / h,  c3 = (qd_i + qd_{i+1} - 2 D) / h^2,

where D = (q_{i+1} - q_i) / h.  Positions are extreme where a quadratic
vanishes, velocities where a line does, accelerations at the ends.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
EPS = float(np.finfo(np.float64).eps)


class Pieces(NamedTuple):
    """Cubic pieces: n rows make n - 1 of them, each of nv coordinates.

    Attributes:
        h: duration of each piece, (n-1,), s.
        c0: coefficients, (n-1, nv), rad (or m).
        c1: rad/s.
        c2: rad/s2.
        c3: rad/s3.
    """

    h: Array
    c0: Array
    c1: Array
    c2: Array
    c3: Array


def pieces(t: Array, q: Array, qd: Array) -> Pieces:
    """Coefficients of the cubic between each two rows.

    Args:
        t: times, increasing, (n,), s.
        q: positions, (n, nv), rad or m.
        qd: velocities, (n, nv), rad/s or m/s.
    """
    h = np.diff(t)
    wide = h[:, None]
    slope = np.diff(q, axis=0) / wide
    c2 = (3 * slope - 2 * qd[:-1] - qd[1:]) / wide
    c3 = (qd[:-1] + qd[1:] - 2 * slope) / wide**2
    return Pieces(h, q[:-1], qd[:-1], c2, c3)


def unit_pieces(t: Array, q: Array, qd: Array) -> Pieces:
    """The same cubics over a local time from 0 to 1, ``s / h``.

    Its dyadic fractions are exact doubles, so intervals of it tile a piece
    without a hole.  With D = q_{i+1} - q_i and V = h qd,

        c1 = V_i,  c2 = 3 D - 2 V_i - V_{i+1},  c3 = V_i + V_{i+1} - 2 D.

    Args:
        t: times, increasing, (n,), s.
        q: positions, (n, nv), rad or m.
        qd: velocities, (n, nv), rad/s or m/s.
    """
    wide = np.diff(t)[:, None]
    move, first, last = np.diff(q, axis=0), wide * qd[:-1], wide * qd[1:]
    c2, c3 = 3 * move - 2 * first - last, first + last - 2 * move
    return Pieces(np.ones(len(wide)), q[:-1], first, c2, c3)


def unit_size(t: Array, q: Array, qd: Array) -> Array:
    """A = 12 |D| + 8 |V_i| + 5 |V_{i+1}|, the largest of all pieces, (nv,).

    No less than the sum of the absolute values of all terms, written out in D
    and V, of |c1| + 2 |c2| + 3 |c3|: what rounding can act on where the motion
    of :func:`unit_pieces` or a derivative of it is evaluated, q_i left out.
    """
    wide = np.diff(t)[:, None]
    ends = wide * (8 * np.abs(qd[:-1]) + 5 * np.abs(qd[1:]))
    size: Array = (12 * np.abs(np.diff(q, axis=0)) + ends).max(axis=0)
    return size


def position(p: Pieces, s: Array) -> Array:
    """Position at local times ``s``, (n-1, 1) or (n-1, nv)."""
    return p.c0 + s * (p.c1 + s * (p.c2 + s * p.c3))


def velocity(p: Pieces, s: Array) -> Array:
    """Velocity at local times ``s``, (n-1, 1) or (n-1, nv)."""
    return p.c1 + s * (2 * p.c2 + 3 * s * p.c3)


def second_derivatives(p: Pieces) -> Array:
    """The ``qdd`` column of a plan: at the start of each piece, last row at its end.

    Returns:
        (n, nv), rad/s2.
    """
    last = 2 * p.c2[-1:] + 6 * p.c3[-1:] * p.h[-1]
    return np.concatenate([2 * p.c2, last])


def _range(values: list[Array]) -> tuple[Array, Array]:
    stack = np.stack(values)
    return stack.min(axis=0), stack.max(axis=0)


def _inside(root: Array, h: Array) -> Array:
    """A root cut to [0, h]: evaluating there is always a true value."""
    cut: Array = np.fmin(np.fmax(root, 0.0), h[:, None])  # NaN becomes 0
    return cut


def position_range(p: Pieces) -> tuple[Array, Array]:
    """Least and greatest position on every piece, two (n-1, nv) arrays."""
    a, b, c = 3 * p.c3, 2 * p.c2, p.c1
    with np.errstate(all="ignore"):
        disc = np.sqrt(np.maximum(b * b - 4 * a * c, 0.0))
        stable = -0.5 * (b + np.where(b < 0, -disc, disc))
        first, second = stable / a, c / stable
    wide = np.broadcast_to(p.h[:, None], p.c0.shape)
    at = [np.zeros_like(wide), wide, _inside(first, p.h), _inside(second, p.h)]
    return _range([position(p, s) for s in at])


def velocity_range(p: Pieces) -> tuple[Array, Array]:
    """Least and greatest velocity on every piece, two (n-1, nv) arrays."""
    with np.errstate(all="ignore"):
        root = -p.c2 / (3 * p.c3)
    wide = np.broadcast_to(p.h[:, None], p.c0.shape)
    at = [np.zeros_like(wide), wide, _inside(root, p.h)]
    return _range([velocity(p, s) for s in at])


def acceleration_range(p: Pieces) -> tuple[Array, Array]:
    """Least and greatest acceleration on every piece, two (n-1, nv) arrays."""
    return _range([2 * p.c2, 2 * p.c2 + 6 * p.c3 * p.h[:, None]])


def rounding(p: Pieces) -> tuple[Array, Array, Array]:
    """Bounds of what double rounding did to the three ranges.

    Written out in slope, qd_i and qd_{i+1}, the terms of a velocity add up to at
    most 12 |slope| + 8 |qd_i| + 5 |qd_{i+1}|, those of an acceleration to
    (18 |slope| + 10 |qd_i| + 8 |qd_{i+1}|) / h, and none passes through more than
    16 roundings: with |slope|, |qd_i| <= speed below and |qd_{i+1}| = end, at
    most 448 u speed + 128 u end, u = EPS / 2.  A position is h times a velocity,
    and q_i.  A root that is off, or was lost because its discriminant vanished
    by rounding, solves a quadratic whose terms are off by 8 u: the velocity is
    below 8 u speed between it and the true one, the extreme off by h times it.

    Returns:
        Bounds for position, velocity and acceleration, (n-1, nv) each.
    """
    wide = p.h[:, None]
    speed = np.abs(p.c1) + np.abs(p.c2) * wide + np.abs(p.c3) * wide**2
    end = np.abs(p.c1 + wide * (2 * p.c2 + 3 * wide * p.c3))
    terms = 256 * EPS * (speed + end)
    return 256 * EPS * np.abs(p.c0) + terms * wide, terms, terms / wide
