"""The convex hull of points: its facets propose normals, its points bound.

``gap`` asks *all* points for their support, so that a hull that came out wrong
can only weaken a bound.  Triangles between points of the solid are in the
solid, so that the distance to one of them refutes.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.check.plans.reading import Array
from rrnn_opt.errors import DocumentError

_CHUNK = 400_000


class Hull:
    """A convex hull in its own axes.

    Args:
        points: (n, 3), m.
        name: of the obstacle, for messages.

    Raises:
        DocumentError: the points lie in a plane.
    """

    def __init__(self, points: Array, name: str) -> None:
        size = float(np.abs(points).max())
        faces = _hull_faces(np.unique(points, axis=0), 1e-10 * (1.0 + size), name)
        self.corners = faces
        turned = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
        self.normals: Array = turned / np.linalg.norm(turned, axis=1)[:, None]
        self.points = np.unique(faces.reshape(-1, 3), axis=0)
        outside = (points @ self.normals.T).max(axis=0)
        self.offsets: Array = outside
        self.all = np.unique(points, axis=0)
        self.size = size

    def support(self, n: Array) -> Array:
        """Largest n.x over the points, (M,), m."""
        step = max(1, _CHUNK // len(self.all))
        parts = [n[i : i + step] @ self.all.T for i in range(0, len(n), step)]
        return np.concatenate([np.zeros(0), *(part.max(axis=1) for part in parts)])

    def nearest(self, local: Array) -> tuple[Array, Array]:
        """Signed distance (M,) and outward unit normal (M, 3)."""
        plane = local @ self.normals.T - self.offsets
        best = np.argmax(plane, axis=1)
        distance, normal = plane[np.arange(len(local)), best], self.normals[best].copy()
        outer = np.flatnonzero(distance > 0.0)
        step = max(1, _CHUNK // len(self.corners))
        for rows in np.split(outer, range(step, len(outer), step)):
            away = local[rows] - _closest(local[rows], self.corners)
            far = np.sqrt(np.einsum("ij,ij->i", away, away))
            usual = far > 1e-12
            distance[rows] = np.maximum(far, distance[rows])
            normal[rows[usual]] = away[usual] / far[usual, None]
        return distance, normal


def _closest(points: Array, corners: Array) -> Array:
    """Nearest point of all triangles (t, 3, 3) to each point, (M, 3)."""
    a, ab, ac = (
        corners[:, 0],
        corners[:, 1] - corners[:, 0],
        corners[:, 2] - corners[:, 0],
    )
    to = points[:, None] - a
    d1, d2 = np.einsum("mti,ti->mt", to, ab), np.einsum("mti,ti->mt", to, ac)
    bb, cc, bc = (
        np.einsum("ti,ti->t", x, y) for x, y in ((ab, ab), (ac, ac), (ab, ac))
    )
    inner = np.maximum(bb * cc - bc * bc, 1e-300)
    v, w = (d1 * cc - d2 * bc) / inner, (d2 * bb - d1 * bc) / inner
    inside = (v >= 0) & (w >= 0) & (v + w <= 1)
    along = np.clip((d2 - d1 + bb - bc) / np.maximum(bb + cc - 2 * bc, 1e-300), 0, 1)
    zero = np.zeros_like(v)
    options = [
        (np.where(inside, v, 0.0), np.where(inside, w, 0.0)),
        (np.clip(d1 / np.maximum(bb, 1e-300), 0, 1), zero),
        (zero, np.clip(d2 / np.maximum(cc, 1e-300), 0, 1)),
        (1 - along, along),
    ]
    found = [a + s[..., None] * ab + t[..., None] * ac for s, t in options]
    spots = np.concatenate(found, axis=1)
    apart = points[:, None] - spots
    best = np.argmin(np.einsum("mti,mti->mt", apart, apart), axis=1)
    return np.asarray(spots[np.arange(len(points)), best])


def _hull_faces(points: Array, slack: float, name: str) -> Array:
    """Corners of the hull's triangles, outwards, (t, 3, 3): the farthest first."""
    faces = _tetrahedron(points, slack, name)
    left = np.arange(len(points))
    while True:
        corners = points[faces]
        n = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        n = n / np.maximum(np.linalg.norm(n, axis=1), 1e-300)[:, None]
        offset = np.einsum("ij,ij->i", n, corners[:, 0])
        above = points[left] @ n.T - offset
        most = above.max(axis=1)
        left, above = left[most > slack], above[most > slack]
        if not len(left):
            return np.asarray(points[faces])
        top = int(np.argmax(above.max(axis=1)))
        faces = _with_point(faces, above[top] > slack, int(left[top]))


def _with_point(
    faces: NDArray[np.int64], seen: NDArray[np.bool_], index: int
) -> NDArray[np.int64]:
    """Faces that a new point sees give way to a cone over their border."""
    gone = faces[seen]
    edges = np.concatenate([gone[:, [0, 1]], gone[:, [1, 2]], gone[:, [2, 0]]])
    known = {(int(b), int(a)) for a, b in edges}
    rim = [(a, b) for a, b in edges if (int(a), int(b)) not in known]
    cone = np.array([[a, b, index] for a, b in rim], dtype=np.int64).reshape(-1, 3)
    return np.concatenate([faces[~seen], cone])


def _tetrahedron(points: Array, slack: float, name: str) -> NDArray[np.int64]:
    """Four points far apart, as outward faces."""
    a = int(np.argmin(points[:, 0]))
    b = int(np.argmax(np.linalg.norm(points - points[a], axis=1)))
    along = points[b] - points[a]
    across = np.cross(points - points[a], along)
    c = int(np.argmax(np.linalg.norm(across, axis=1)))
    normal = np.cross(along, points[c] - points[a])
    height = (points - points[a]) @ normal
    d = int(np.argmax(np.abs(height)))
    if abs(height[d]) <= slack * max(float(np.linalg.norm(normal)), 1e-300):
        raise DocumentError(f"{name}.path", "the vertices lie in a plane")
    if height[d] > 0:
        b, c = c, b
    return np.array([[a, b, c], [a, d, b], [b, d, c], [c, d, a]], dtype=np.int64)
