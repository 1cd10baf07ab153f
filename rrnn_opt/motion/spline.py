"""A smooth curve near a polyline that never leaves its convex hull."""

from __future__ import annotations

from typing import Any

import numpy as np

from rrnn_opt.motion.path import Array, Path

DEGREE = 3
FEWEST_SPANS = 4
STRAIGHT = 1e-3
"""A span turns by less than this, rad of the curve's direction, where it is straight:
the second derivative at a knot over the first, times the span."""


class SmoothPath:
    """Cubic B-spline whose control points lie on a polyline.

    Control point i stands at the polyline's relative arc length g_i, the
    average of three neighbouring knots (Schoenberg's operator).  So straight
    stretches longer than four spans are followed exactly and at even speed,
    corners are rounded within a span, and the curve stays in the convex hull
    of the polyline: a joint box that holds the polyline holds the curve, which
    an interpolating spline does not grant.  It has the interface that toppra
    asks of a path.

    Attributes:
        spans: number of polynomial pieces.
        dof: coordinates, nv.
        path_interval: (2,), always 0 and 1.
        duration: 1.
    """

    def __init__(self, path: Path, *, spacing: float, scale: float) -> None:
        """Smooth a path.

        Args:
            path: the polyline, of positive length.
            spacing: largest knot distance along the path, rad or m.
            scale: lengths are divided by it.
        """
        from scipy.interpolate import BSpline

        self.spans = max(FEWEST_SPANS, int(np.ceil(path.length / spacing)))
        inner = np.linspace(0.0, 1.0, self.spans + 1)
        knots = np.concatenate([np.zeros(DEGREE), inner, np.ones(DEGREE)])
        places = np.convolve(knots[1:-1], np.full(DEGREE, 1 / DEGREE), "valid")
        points = path.at(places * path.length)
        points[0], points[-1] = path.start, path.goal
        self._spline: Any = BSpline(knots, points / scale, DEGREE)
        self.dof = points.shape[1]
        self.path_interval = np.array([0.0, 1.0])
        self.duration = 1.0

    def __call__(self, s: Any, order: int = 0) -> Array:
        """The curve or its derivative of that order at ``s`` in [0, 1]."""
        return np.asarray(self._spline(s, nu=order), dtype=np.float64)

    def grid(self, fewest: int, bent: int = 1) -> Array:
        """Parameters that hold every knot, ``fewest`` spans at least, (n,).

        Along a straight line the rows' cubics follow any timing exactly, so rows
        are placed where the curve bends.

        Args:
            fewest: least number of steps.
            bent: steps of a span that bends for one of a straight span.
        """
        knots = np.linspace(0.0, 1.0, self.spans + 1)
        turn, speed = np.abs(self(knots, 2)).max(axis=1), np.abs(self(knots, 1)).max()
        straight = turn <= STRAIGHT * self.spans * speed
        steps = np.where(straight[:-1] & straight[1:], 1, bent)
        steps *= max(1, -(-fewest // int(steps.sum())))
        first = np.repeat(np.cumsum(steps) - steps, steps)
        inner = (np.arange(len(first)) - first) / np.repeat(steps, steps)
        place = np.repeat(np.arange(self.spans), steps) + inner
        return np.append(place / self.spans, 1.0)
