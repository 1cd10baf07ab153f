"""Convex polygons in space, cut by planes; many at once, as (n, k, 3) corners."""

from __future__ import annotations

import numpy as np

from rrnn_opt.robot.tree import Array


def cut(corners: Array, axis: Array) -> list[Array]:
    """Polygons on both sides of the plane across the middle of an axis."""
    spread = corners @ axis
    height = spread - 0.5 * (spread.min() + spread.max())
    below, above = np.all(height <= 0.0, axis=1), np.all(height >= 0.0, axis=1)
    crossed = ~below & ~above
    sides = []
    for whole, sign in ((below, -1.0), (above & ~below, 1.0)):
        both = zip(corners[crossed], sign * height[crossed], strict=True)
        sides.append(_joined(corners[whole], [_clipped(*each) for each in both]))
    return [side for side in sides if len(side)]


def _clipped(polygon: Array, height: Array) -> Array:
    """Corners (k, 3) of the part of a polygon where the height is not negative."""
    fresh = np.any(polygon != np.roll(polygon, 1, axis=0), axis=1)
    corners, height = polygon[fresh], height[fresh]
    kept: list[Array] = []
    for k in range(len(corners)):
        a, b = height[k], height[k - 1]
        if a * b < 0.0:
            kept.append(corners[k] + a / (a - b) * (corners[k - 1] - corners[k]))
        if a >= 0.0:
            kept.append(corners[k])
    return np.array(kept)


def _joined(polygons: Array, more: list[Array]) -> Array:
    """All polygons in one array, the last corner of the shorter ones repeated.

    A polygon that is cut stays one: it has a corner more at most.  Triangles would
    double in number with each further cut along the same axis.
    """
    width = max([polygons.shape[1], *map(len, more)])
    last = np.arange(width)
    padded = [each[np.minimum(last, len(each) - 1)][None] for each in more]
    wide = polygons[:, np.minimum(last, polygons.shape[1] - 1)]
    return np.concatenate([wide, *padded])
