"""A smooth curve near a polyline that never leaves its convex hull."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

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
    an interpolating spline does not grant.

    Attributes:
        spans: number of polynomial pieces, all as long in the parameter.
    """

    def __init__(self, path: Path, *, spacing: float, scale: float) -> None:
        """Smooth a path.

        Args:
            path: the polyline, of positive length.
            spacing: largest knot distance along the path, rad or m.
            scale: lengths are divided by it.
        """
        self.spans = max(FEWEST_SPANS, int(np.ceil(path.length / spacing)))
        inner = np.linspace(0.0, 1.0, self.spans + 1)
        self._knots = np.concatenate([np.zeros(DEGREE), inner, np.ones(DEGREE)])
        places = np.convolve(self._knots[1:-1], np.full(DEGREE, 1 / DEGREE), "valid")
        points = path.at(places * path.length)
        points[0], points[-1] = path.start, path.goal
        self._points: Array = points / scale

    def __call__(self, s: ArrayLike, order: int = 0) -> Array:
        """The curve or its derivative of that order, 0 to 3, at ``s`` in [0, 1]."""
        knots, points = self._knots, self._points
        for degree in range(DEGREE, DEGREE - order, -1):
            length = knots[degree + 1 : -1] - knots[1 : -degree - 1]
            points = degree * np.diff(points, axis=0) / length[:, None]
            knots = knots[1:-1]
        degree, where = DEGREE - order, np.asarray(s, dtype=np.float64)
        span = np.searchsorted(knots[degree:-degree], where, side="right") - 1
        span = degree + np.clip(span, 0, self.spans - 1)
        basis = _basis(knots, degree, span, where)
        near = span[..., None] + np.arange(-degree, 1)
        return np.asarray(np.einsum("...k,...kj->...j", basis, points[near]))

    def grid(self, fewest: int) -> Array:
        """Parameters that hold every knot, ``fewest`` at least, (n,)."""
        each = max(2, int(np.ceil(fewest / self.spans)))
        return np.linspace(0.0, 1.0, self.spans * each + 1)


def _basis(knots: Array, degree: int, span: NDArray[np.intp], s: Array) -> Array:
    """The degree + 1 B-splines that are not zero in their span, (..., degree + 1).

    L. Piegl and W. Tiller, The NURBS Book, 2nd ed., algorithm A2.2.
    """
    found = [np.ones_like(s)]
    for j in range(1, degree + 1):
        saved, raised = np.zeros_like(s), []
        for r, value in enumerate(found):
            right, left = knots[span + r + 1] - s, s - knots[span + r + 1 - j]
            share = value / (right + left)
            raised.append(saved + right * share)
            saved = left * share
        found = [*raised, saved]
    return np.stack(found, axis=-1)
