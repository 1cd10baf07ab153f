"""The reference of the tip over time: positions and their exact derivatives.

With the phase phi(t), smooth: phi = 2 pi sin^2(pi t / 2T) and
phi' = (pi^2 / T) sin(pi t / T); uniform: phi = 2 pi t / T; and the plane's
axes a, b the curves are

    circle    c + R (cos phi a + sin phi b), or through the tip's start p with
              c = p + R a:  p + R ((1 - cos phi) a + sin phi b)
    figure8   c + R (sin phi a + sin phi cos phi b)
    line      p + phi / 2 pi (end - p)
    point     the point, at all times
"""

from __future__ import annotations

import numpy as np

from rrnn_opt.simulation.task import PLANES, Array, Curve


def reference(curve: Curve, tip: Array, t: Array) -> tuple[Array, Array]:
    """Positions and velocities of the reference.

    Args:
        curve: the task's curve.
        tip: (3,) position of the tip at the start, m.
        t: (k,) times, s.

    Returns:
        rd, (k, 3), m, and rd_dot, (k, 3), m/s.
    """
    phi, rate = _phase(curve, t)
    if curve.kind == "point":
        return np.tile(_end(curve, tip), (t.size, 1)), np.zeros((t.size, 3))
    if curve.kind == "line":
        way = (_end(curve, tip) - tip)[None, :] / (2.0 * np.pi)
        return tip + phi[:, None] * way, rate[:, None] * way
    first, second = (np.eye(3)[axis] for axis in PLANES[curve.plane])
    along, across, d_along, d_across = _closed(curve, phi)
    centre = tip if curve.centre is None else curve.centre
    rd = centre + curve.radius * (np.outer(along, first) + np.outer(across, second))
    slope = np.outer(d_along, first) + np.outer(d_across, second)
    return rd, curve.radius * rate[:, None] * slope


def _phase(curve: Curve, t: Array) -> tuple[Array, Array]:
    T = curve.period
    if curve.profile == "uniform":
        return 2.0 * np.pi * t / T, np.full(t.shape, 2.0 * np.pi / T)
    phi = 2.0 * np.pi * np.sin(0.5 * np.pi * t / T) ** 2
    return phi, np.pi**2 / T * np.sin(np.pi * t / T)


def _closed(curve: Curve, phi: Array) -> tuple[Array, Array, Array, Array]:
    """Both coordinates in units of the radius, and their slopes in phi."""
    sin, cos = np.sin(phi), np.cos(phi)
    if curve.kind == "figure8":
        return sin, sin * cos, cos, np.cos(2.0 * phi)
    if curve.centre is None:
        return 1.0 - cos, sin, sin, cos
    return cos, sin, -sin, cos


def _end(curve: Curve, tip: Array) -> Array:
    """Where the line ends, or the point stands."""
    if curve.position is not None:
        return curve.position
    if curve.offset is None:
        raise ValueError("a line or point needs an offset or a position")
    return tip + curve.offset
