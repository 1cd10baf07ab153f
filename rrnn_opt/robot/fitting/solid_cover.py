"""Few spheres that contain a triangulated surface, by bisection.

A part of the surface is held by a ball about its corners: the smallest one, or
one whose centre lies deeper in the solid, which is larger but bulges less (for a
flat part of radius s by s^2 / 2t at depth t).  A ball is convex, so it holds the
triangles too.  The part whose ball bulges most out of the solid is cut in two by a
plane across one of its principal axes, whichever leaves the smaller bulge
(triangles on the plane are clipped to polygons, so nothing is lost), until no ball
bulges by more than is wanted or there are enough of them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.robot.fitting.ball import directions, outermost, smallest_ball
from rrnn_opt.robot.fitting.polygons import cut
from rrnn_opt.robot.tree import Array

PADDING = 2e-4
"""Added to every radius, m: neighbours then overlap along the cut between them,
so that the surface can be shown to be covered by cutting triangles finitely."""
DEPTHS = (0.0, 0.5, 1.0, 2.0)
"""How deep a ball's centre is tried, times the radius of the smallest ball."""
_SAMPLES = 6000
_FLAT = 1e-9
"""Extent along an axis, of the largest, that is rounding: there is no middle."""


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
class Part:
    """A piece of a surface and the ball that holds it.

    Attributes:
        corners: of its convex polygons, (t, k, 3), m; triangles as long as they
            are not cut, the last corner repeated where there are fewer than k.
        center: of the ball, (3,), m.
        radius: m.
        bulge: how far the ball is seen to come out of the solid, m.
    """

    corners: Array
    center: Array
    radius: float
    bulge: float


Burden = Callable[[Array, float], float]


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
    parts = solid_parts(Surface(vertices, triangles), inflation, most)
    return SolidCover(
        np.array([part.center for part in parts]),
        np.array([part.radius for part in parts]),
        max(part.bulge for part in parts),
    )


def solid_parts(surface: Surface, inflation: float, most: int) -> list[Part]:
    """Parts of a surface whose balls hold it, as in ``cover_solid``."""
    parts = [_part(surface.corners, surface)]
    while len(parts) < most:
        worst = max(range(len(parts)), key=lambda k: parts[k].bulge)
        if parts[worst].bulge <= inflation:
            break
        parts[worst : worst + 1] = halves(parts[worst], surface)
    return parts


def _part(
    corners: Array,
    surface: Surface,
    burden: Burden | None = None,
    most: float = 0.0,
) -> Part:
    """The ball of least bulge; of least burden, where none bulges beyond ``most``."""
    points = corners.reshape(-1, 3)
    middle, least = smallest_ball(outermost(points))
    inwards = _inwards(corners)
    best: tuple[tuple[float, float], Part] | None = None
    for depth in DEPTHS:
        center = middle + depth * least * inwards
        radius = float(np.linalg.norm(points - center, axis=1).max()) + PADDING
        bulge = float(surface.outside(center + radius * directions()).max())
        load = 0.0 if burden is None else burden(center, radius)
        cost = max(bulge, most), load
        if best is None or cost < best[0]:
            best = cost, Part(corners, center, radius, bulge)
    assert best is not None
    return best[1]


def _inwards(corners: Array) -> Array:
    """Mean inward normal of polygons, (3,); shorter where they turn."""
    spokes = corners - corners[:, :1]
    across = np.cross(spokes[:, 1:-1], spokes[:, 2:]).sum(axis=1)
    area = float(np.linalg.norm(across, axis=1).sum())
    return np.asarray(-across.sum(axis=0) / max(area, 1e-300))


def halves(
    part: Part,
    surface: Surface,
    burden: Burden | None = None,
    most: float = 0.0,
) -> list[Part]:
    """Both sides of the best plane across the middle of a principal axis.

    A part that is a point stays whole.

    Args:
        part: to be cut.
        surface: that it belongs to.
        burden: of a ball with this centre and radius; the sum over both sides is
            made least, in place of the larger bulge.
        most: bulge that then costs nothing, m.
    """
    corners = part.corners
    points = corners.reshape(-1, 3)
    middle = points - points.mean(axis=0)
    axes = np.linalg.eigh(middle.T @ middle)[1]
    extent = np.ptp(middle @ axes, axis=0)
    best: list[Part] = [part]
    least = (np.inf, np.inf)
    for axis in axes.T[extent > _FLAT * extent.max()]:
        found = [_part(side, surface, burden, most) for side in cut(corners, axis)]
        cost = _cost(found)
        if burden is not None:
            load = sum(burden(p.center, p.radius) for p in found)
            cost = max(cost[0], most), load
        if cost < least:
            best, least = found, cost
    return best


def _cost(parts: list[Part]) -> tuple[float, float]:
    return max(p.bulge for p in parts), sum(p.radius for p in parts)
