"""The reference of the tip over time: positions and two exact derivatives.

With the phase phi(t), smooth: phi = 2 pi sin^2(pi t / 2T), whose slope is
(pi^2 / T) sin(pi t / T); uniform: phi = 2 pi t / T; and the plane's axes a, b
the curves are

    circle    c + R (cos phi a + sin phi b), or through the tip's start p with
              c = p + R a:  p + R ((1 - cos phi) a + sin phi b)
    figure8   c + R (sin phi a + sin phi cos phi b)
    line      p + phi / 2 pi (end - p)
    point     the point, at all times
"""

from __future__ import annotations

import numpy as np

from rrnn_opt.errors import ProblemError
from rrnn_opt.simulation.task_parts import PLANES, Array, Curve


def reference(curve: Curve, tip: Array, t: Array) -> tuple[Array, Array, Array]:
    """Positions, velocities and accelerations of the reference.

    Args:
        curve: the task's curve.
        tip: (3,) position of the tip at the start, m.
        t: (k,) times, s.

    Returns:
        rd, (k, 3), m; rd_dot, (k, 3), m/s; rd_ddot, (k, 3), m/s2.

    Raises:
        ProblemError: a line or point has neither offset nor position.
    """
    phi, rate, second = _phase(curve, t)
    if curve.kind == "point":
        still = np.zeros((t.size, 3))
        return np.tile(_end(curve, tip), (t.size, 1)), still, still.copy()
    if curve.kind == "line":
        way = (_end(curve, tip) - tip)[None, :] / (2.0 * np.pi)
        return tip + phi[:, None] * way, rate[:, None] * way, second[:, None] * way
    axes = np.eye(3)[list(PLANES[curve.plane])]
    place, slope, bend = (c @ axes for c in _closed(curve, phi))
    centre = tip if curve.centre is None else curve.centre
    velocity = rate[:, None] * slope
    acceleration = second[:, None] * slope + rate[:, None] ** 2 * bend
    return (
        centre + curve.radius * place,
        curve.radius * velocity,
        curve.radius * acceleration,
    )


def _phase(curve: Curve, t: Array) -> tuple[Array, Array, Array]:
    """The phase and its first two derivatives."""
    T = curve.period
    if curve.profile == "uniform":
        rate = np.full(t.shape, 2.0 * np.pi / T)
        return 2.0 * np.pi * t / T, rate, np.zeros(t.shape)
    phi = 2.0 * np.pi * np.sin(0.5 * np.pi * t / T) ** 2
    turn = np.pi * t / T
    return phi, np.pi**2 / T * np.sin(turn), np.pi**3 / T**2 * np.cos(turn)


def _closed(curve: Curve, phi: Array) -> tuple[Array, Array, Array]:
    """Coordinates in units of the radius, (k, 2), and two derivatives in phi."""
    sin, cos = np.sin(phi), np.cos(phi)
    if curve.kind == "figure8":
        twice = 2.0 * phi
        parts = (sin, sin * cos), (cos, np.cos(twice)), (-sin, -2.0 * np.sin(twice))
    elif curve.centre is None:
        parts = (1.0 - cos, sin), (sin, cos), (cos, -sin)
    else:
        parts = (cos, sin), (-sin, cos), (-cos, -sin)
    place, slope, bend = (np.column_stack(p) for p in parts)
    return place, slope, bend


def _end(curve: Curve, tip: Array) -> Array:
    """Where the line ends, or the point stands."""
    if curve.position is not None:
        return curve.position
    if curve.offset is None:
        raise ProblemError("reference", "a line or point needs 'offset' or 'position'")
    return tip + curve.offset
