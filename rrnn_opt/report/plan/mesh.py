"""Meshes of the solids that are drawn: quadrilaterals over plain arrays.

Boxes are tiled, since painters sort small faces well and large ones badly.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rrnn_opt.scene.pose import frame_around

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Mesh:
    """A surface of quadrilaterals, counter-clockwise seen from outside.

    Attributes:
        vertices: (v, 3), m.
        quads: four vertex indices a face, (f, 4); a triangle repeats one.
    """

    vertices: Array
    quads: NDArray[np.int64]

    def moved(self, pose: Array) -> Mesh:
        """The mesh seen from the frame in which ``pose`` (4, 4) is given."""
        return Mesh(self.vertices @ pose[:3, :3].T + pose[:3, 3], self.quads)

    @property
    def corners(self) -> Array:
        """Corner points of the faces, (f, 4, 3), m."""
        picked: Array = self.vertices[self.quads]
        return picked

    @property
    def triangles(self) -> NDArray[np.int64]:
        """Vertex indices of triangles without those of no area, (k, 3)."""
        both = np.concatenate([self.quads[:, [0, 1, 2]], self.quads[:, [0, 2, 3]]])
        a, b, c = (self.vertices[both[:, i]] for i in range(3))
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        kept: NDArray[np.int64] = both[area > 1e-12]
        return kept


def merged(meshes: Iterable[Mesh]) -> Mesh:
    """One mesh of several."""
    vertices, quads, count = [np.zeros((0, 3))], [np.zeros((0, 4), np.int64)], 0
    for mesh in meshes:
        vertices.append(mesh.vertices)
        quads.append(mesh.quads + count)
        count += len(mesh.vertices)
    return Mesh(np.concatenate(vertices), np.concatenate(quads))


def surface(points: Array) -> Mesh:
    """The mesh of a grid of points, (m, n, 3)."""
    rows, columns = points.shape[:2]
    index = np.arange(rows * columns).reshape(rows, columns)
    quads = np.stack(
        [index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]], axis=-1
    )
    return Mesh(points.reshape(-1, 3), quads.reshape(-1, 4))


def revolved(profile: ArrayLike, sides: int) -> Mesh:
    """A profile turned around the z axis.

    Args:
        profile: radius and height of its points, (k, 2), m.
        sides: faces around the axis.
    """
    r, z = np.asarray(profile, dtype=float).T
    angle = np.linspace(0.0, 2 * np.pi, sides + 1)
    grid = np.empty((sides + 1, len(r), 3))
    grid[..., 0] = np.cos(angle)[:, None] * r
    grid[..., 1] = np.sin(angle)[:, None] * r
    grid[..., 2] = z
    return surface(grid)


def sphere(centre: ArrayLike, radius: float, *, sides: int = 10) -> Mesh:
    """A ball around ``centre`` (3,)."""
    polar = np.linspace(np.pi, 0.0, sides // 2 + 1)
    mesh = revolved(np.column_stack([np.sin(polar), np.cos(polar)]) * radius, sides)
    return Mesh(mesh.vertices + np.asarray(centre, dtype=float), mesh.quads)


def capsule_z(
    radius: float, low: float, high: float, *, sides: int = 12, flat: bool = False
) -> Mesh:
    """A capsule along z with sphere centres at heights ``low`` and ``high``.

    Args:
        radius: m.
        low: m.
        high: m.
        sides: faces around the axis.
        flat: without the lower cap.
    """
    polar = np.linspace(np.pi / 2, 0.0, max(2, sides // 4) + 1)
    cap = np.column_stack([np.sin(polar), np.cos(polar)]) * radius
    bottom = (cap[:1] if flat else cap[::-1] * [1.0, -1.0]) + np.array([0.0, low])
    pieces = 1 + int((high - low) / (2.0 * radius))
    between = np.linspace(low, high, pieces + 1)[1:-1]
    straight = np.column_stack([np.full(pieces - 1, radius), between])
    top = cap + np.array([0.0, high])
    return revolved(np.concatenate([bottom, straight, top]), sides)


def capsule(
    a: Array, b: Array, radius: float, *, sides: int = 12, flat: bool = False
) -> Mesh:
    """All points within ``radius`` of the segment from ``a`` to ``b``, m."""
    length, pose = _along(a, b)
    return capsule_z(radius, 0.0, length, sides=sides, flat=flat).moved(pose)


def tube(a: Array, b: Array, radius: float, *, sides: int = 6) -> Mesh:
    """A thin open tube from ``a`` to ``b``, (3,) each, m."""
    length, pose = _along(a, b)
    return revolved([[radius, 0.0], [radius, length]], sides).moved(pose)


def cylinder_z(radius: float, low: float, high: float, *, sides: int = 28) -> Mesh:
    """A cylinder along z between two heights."""
    rings = np.array([0.0, 0.3, 0.55, 0.8, 1.0, 1.0]) * radius  # sharp edges
    profile = [[r, low] for r in rings] + [[r, high] for r in rings[::-1]]
    return revolved(profile, sides)


def box(low: Array, high: Array, *, tile: float) -> Mesh:
    """A box between two corners (3,), its faces in tiles of about ``tile`` m."""
    faces = []
    for axis in range(3):
        first, second = (axis + 1) % 3, (axis + 2) % 3
        for end, outwards in ((low, -1), (high, 1)):
            grid = plate(low, high, (first, second), tile)
            grid[..., axis] = end[axis]
            face = surface(grid)
            faces.append(Mesh(face.vertices, face.quads[:, ::outwards]))
    return merged(faces)


def plate(low: Array, high: Array, axes: tuple[int, int], tile: float) -> Array:
    """Grid points, (m, n, 3), of the rectangle that a box has in two axes."""
    first, second = axes
    u, v = (
        np.linspace(low[k], high[k], 2 + int((high[k] - low[k]) / tile))
        for k in (first, second)
    )
    grid = np.zeros((len(u), len(v), 3))
    grid[..., first], grid[..., second] = u[:, None], v
    return grid


def _along(a: Array, b: Array) -> tuple[float, Array]:
    """Length of a segment and a pose at ``a`` whose z axis runs along it."""
    length = float(np.linalg.norm(b - a))
    pose = np.eye(4)
    pose[:3, 3] = a
    if length > 0.0:
        pose[:3, :3] = frame_around((b - a) / length)
    return length, pose
