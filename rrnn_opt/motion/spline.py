"""A smooth curve near a polyline that never leaves its convex hull."""

from __future__ import annotations

from typing import Any

import numpy as np

from rrnn_opt.motion.path import Array, Path

DEGREE = 3
FEWEST_SPANS = 4


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

    def grid(self, fewest: int) -> Array:
        """Parameters that hold every knot, ``fewest`` at least, (n,)."""
        each = max(2, int(np.ceil(fewest / self.spans)))
        return np.linspace(0.0, 1.0, self.spans * each + 1)
