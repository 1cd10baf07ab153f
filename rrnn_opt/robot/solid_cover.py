"""Few spheres that contain a triangulated surface, by bisection.

A part of the surface is held by a ball about its corners: the smallest one, or
one whose centre lies deeper in the solid, which is larger but bulges less (for a
flat part of radius s by s^2 / 2t at depth t).  A ball is convex, so it holds the
triangles too.  The part whose ball bulges most out of
the solid is cut in two by a plane across one of its principal axes, whichever
leaves the smaller bulge (triangles on the plane are clipped, so nothing is
lost), until no ball bulges by more than is wanted or there are enough of them.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.robot.tree import Array

PADDING = 2e-4
"""Added to every radius, m: neighbours then overlap along the cut between them,
so that the surface can be shown to be covered by cutting triangles finitely."""
DEPTHS = (0.0, 0.5, 1.0, 2.0)
"""How deep a ball's centre is tried, times the radius of the smallest ball."""
_STEPS = 64
_DIRECTIONS = 96
_SAMPLES = 6000


@dataclass(frozen=True, eq=False)
class SolidCover:
    """Spheres whose union contains a surface.

    Attributes:
        centers: (n, 3), m.
        radii: (n,), m.
        inflation: how far the spheres bulge out of the solid, measured at
            directions all around each of them, m.
    """

    centers: Array
    radii: Array
    inflation: float


@dataclass(frozen=True, eq=False)
class _Part:
    """Corners of triangles, (t, 3, 3), and the ball about them."""

    corners: Array
    center: Array
    radius: float
    bulge: float


class Surface:
    """A triangulated surface that tells how far a point is outside of it.

    Args:
        vertices: (v, 3), m.
        triangles: vertex indices, (t, 3), outwards (turned if they are not).
    """

    def __init__(self, vertices: Array, triangles: NDArray[np.int64]) -> None:
        corners = np.asarray(vertices, dtype=np.float64)[triangles]
        volume = np.einsum(
            "ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])
        )
        self.corners: Array = corners[:, ::-1] if volume < 0.0 else corners

    @cached_property
    def _samples(self) -> tuple[object, Array, Array]:
        """Points all over the surface in a search tree, and normals there."""
        from scipy.spatial import cKDTree

        a, b, c = (self.corners[:, k] for k in range(3))
        across = np.cross(b - a, c - a)
        area = np.linalg.norm(across, axis=1)
        share = np.ceil(_SAMPLES * area / max(float(area.sum()), 1e-300)).astype(int)
        owner = np.repeat(np.arange(len(area)), np.maximum(share, 1))
        u, v = np.random.default_rng(0).random((2, len(owner)))
        u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
        points = a[owner] + u[:, None] * (b - a)[owner] + v[:, None] * (c - a)[owner]
        unit = across / np.maximum(area, 1e-300)[:, None]
        return cKDTree(points), points, unit[owner]

    def outside(self, points: Array) -> Array:
        """Distance of points (n, 3) from the samples; zero behind the surface."""
        tree, samples, normals = self._samples
        distance, nearest = tree.query(points)  # type: ignore[attr-defined]
        ahead = np.einsum("ij,ij->i", points - samples[nearest], normals[nearest]) > 0.0
        return np.where(ahead, distance, 0.0)


def cover_solid(
    vertices: Array,
    triangles: NDArray[np.int64],
    *,
    inflation: float = 0.01,
    most: int = 64,
) -> SolidCover:
    """Spheres that contain a triangulated surface.

    Args:
        vertices: (v, 3), m.
        triangles: vertex indices, (t, 3).
        inflation: wanted bulge, m; missed when ``most`` is too small.
        most: largest number of spheres.

    Returns:
        The cover.
    """
    surface = Surface(vertices, triangles)
    parts = [_part(surface.corners, surface)]
    while len(parts) < most:
        worst = max(range(len(parts)), key=lambda k: parts[k].bulge)
        if parts[worst].bulge <= inflation:
            break
        parts[worst : worst + 1] = _halves(parts[worst].corners, surface)
    return SolidCover(
        np.array([part.center for part in parts]),
        np.array([part.radius for part in parts]),
        max(part.bulge for part in parts),
    )


def _part(corners: Array, surface: Surface) -> _Part:
    points = corners.reshape(-1, 3)
    middle, least = smallest_ball(points)
    inwards = _inwards(corners)
    best: _Part | None = None
    for depth in DEPTHS:
        center = middle + depth * least * inwards
        radius = float(np.linalg.norm(points - center, axis=1).max()) + PADDING
        bulge = float(surface.outside(center + radius * _directions()).max())
        if best is None or bulge < best.bulge:
            best = _Part(corners, center, radius, bulge)
    assert best is not None
    return best


def _inwards(corners: Array) -> Array:
    """Mean inward normal of triangles, (3,); shorter where they turn."""
    a, b, c = (corners[:, k] for k in range(3))
    across = np.cross(b - a, c - a)
    area = float(np.linalg.norm(across, axis=1).sum())
    return np.asarray(-across.sum(axis=0) / max(area, 1e-300))


def smallest_ball(points: Array) -> tuple[Array, float]:
    """A ball that holds all points (n, 3), little larger than the smallest.

    Badoiu and Clarkson (SODA 2003): step k goes 1/(k + 1) of the way to the
    farthest point; the radius is the largest distance at the end.
    """
    points = np.unique(points, axis=0)
    center = 0.5 * (points.min(axis=0) + points.max(axis=0))
    best, least = center, np.inf
    for k in range(_STEPS):
        away = np.linalg.norm(points - center, axis=1)
        far = int(np.argmax(away))
        if away[far] < least:
            best, least = center, float(away[far])
        center = center + (points[far] - center) / (k + 2)
    return best, least


def _directions() -> Array:
    """Unit vectors spread evenly over the sphere, (n, 3)."""
    k = np.arange(_DIRECTIONS) + 0.5
    z = 1 - 2 * k / _DIRECTIONS
    turn = np.pi * (1 + 5**0.5) * k
    flat = np.sqrt(1 - z * z)
    return np.stack([flat * np.cos(turn), flat * np.sin(turn), z], axis=1)


def _halves(corners: Array, surface: Surface) -> list[_Part]:
    """Both sides of the best plane across the middle of a principal axis."""
    points = corners.reshape(-1, 3)
    middle = points - points.mean(axis=0)
    axes = np.linalg.eigh(middle.T @ middle)[1]
    best: list[_Part] = []
    for axis in axes.T:
        halves = [_part(side, surface) for side in _cut(corners, axis)]
        if not best or _cost(halves) < _cost(best):
            best = halves
    return best


def _cost(parts: list[_Part]) -> tuple[float, float]:
    return max(p.bulge for p in parts), sum(p.radius for p in parts)


def _cut(corners: Array, axis: Array) -> list[Array]:
    """Triangles on both sides of the plane across the middle of an axis."""
    spread = corners @ axis
    height = spread - 0.5 * (spread.min() + spread.max())
    below, above = np.all(height <= 0.0, axis=1), np.all(height >= 0.0, axis=1)
    sides = [[corners[below]], [corners[above & ~below]]]
    crossed = ~below & ~above
    for triangle, h in zip(corners[crossed], height[crossed], strict=True):
        for side, sign in enumerate((-1.0, 1.0)):
            sides[side].append(_clipped(triangle, sign * h))
    joined = [np.concatenate(side) for side in sides]
    return [side for side in joined if len(side)]


def _clipped(triangle: Array, height: Array) -> Array:
    """Triangles of the part of one (3, 3) where the height is not negative."""
    kept: list[Array] = []
    for k in range(3):
        a, b = height[k], height[k - 2]
        if a >= 0.0:
            kept.append(triangle[k])
        if a * b < 0.0:
            share = a / (a - b)
            kept.append(triangle[k] + share * (triangle[k - 2] - triangle[k]))
    fan = [[kept[0], kept[i], kept[i + 1]] for i in range(1, len(kept) - 1)]
    return np.array(fan).reshape(-1, 3, 3)
