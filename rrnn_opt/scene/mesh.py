"""The convex hull of a mesh file as an obstacle: an intersection of half-spaces.

The largest of the facets' plane distances never exceeds the distance to the
hull, and equals it wherever a facet is nearest: a lower bound, which is what
a proof needs.  Beyond edges and corners it is smaller than the distance; sharp
ones therefore get planes of their own, touching the hull there, along the sum
of the neighbours' normals (a box then has 26 planes in place of 6, and the
bound is at least 0.92 of the distance in place of 0.58).  Offsets are the
largest n.v over *all* vertices of the file, so that no rounding of the hull
can cut a corner off.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.errors import ProblemError
from rrnn_opt.scene import fields as check
from rrnn_opt.scene.digest import sha256
from rrnn_opt.scene.mesh_file import read_vertices
from rrnn_opt.scene.pose import IDENTITY, frame_around, matrix_from_quaternion
from rrnn_opt.scene.shapes import PACKED

Array = NDArray[np.float64]

SAME_PLANE = 1e-9
"""Facets whose normals differ by less are one."""
SHARP = 0.9
"""Edges whose facets' normals have a smaller product get a plane of their own."""


@dataclass(frozen=True, eq=False)
class Mesh:
    """The convex hull of a mesh file's vertices.

    Attributes:
        name: shown in reports and witnesses.
        path: the file, .stl or .obj (others need trimesh).
        scale: factor from lengths of the file to metres.
        position: of the file's origin, (3,), m.
        quat_xyzw: orientation, (4,).
        sha256: digest of the file; given, it must be this one.
        vertices: corners of the hull in the file's axes, scaled, (v, 3), m.
        triangles: indices of the hull's triangles, outwards, (t, 3).
        normals: outward normals of facets, sharp edges and corners in the
            file's axes, (k, 3).
        offsets: of their planes, (k,), m.

    Raises:
        ProblemError: a number is not finite, the scale not positive, the file
            cannot be read or is another one, or its vertices lie in a plane.
    """

    kind: ClassVar[str] = "mesh"
    name: str
    path: str
    scale: float = 1.0
    position: Array = field(default_factory=lambda: np.zeros(3))
    quat_xyzw: Array = field(default_factory=lambda: np.array(IDENTITY))
    sha256: str = ""
    vertices: Array = field(init=False, repr=False)
    triangles: NDArray[np.int64] = field(init=False, repr=False)
    normals: Array = field(init=False, repr=False)
    offsets: Array = field(init=False, repr=False)

    def __post_init__(self) -> None:
        path = Path(check.text(self.path, "path"))
        scale = check.positive(self.scale, "scale")
        points = scale * read_vertices(path)
        if np.abs(points).max() > check.LARGEST:
            raise ProblemError("scale", f"vertices lie beyond {check.LARGEST:g} m")
        values: dict[str, Any] = {
            "name": check.text(self.name, "name"),
            "path": str(path),
            "scale": scale,
            "position": check.vector(self.position, 3, "position"),
            "quat_xyzw": check.unit(self.quat_xyzw, 4, "quat_xyzw")[0],
            "sha256": sha256(path, self.sha256),
            **_hull(points, path.name),
        }
        for key, value in values.items():
            object.__setattr__(self, key, value)

    @property
    def rotation(self) -> Array:
        """Axes as columns, (3, 3)."""
        return matrix_from_quaternion(self.quat_xyzw)

    def to_dict(self) -> dict[str, Any]:
        """The obstacle as the problem file writes it."""
        return {
            "name": self.name,
            "type": self.kind,
            "path": self.path,
            "scale": self.scale,
            "position": self.position.tolist(),
            "quat_xyzw": self.quat_xyzw.tolist(),
            "sha256": self.sha256,
        }

    def pack(self) -> Array:
        """A header with the number of facets, then one half-space a facet.

        Returns:
            (1 + k, 16), m; the header's entry 12 is k, its position the centre
            of the hull's box.
        """
        turned = self.normals @ self.rotation.T
        packed = np.zeros((1 + len(turned), PACKED))
        packed[0, 9:12] = self.bounds().mean(axis=0)
        packed[0, 12] = len(turned)
        for row, normal in zip(packed[1:], turned, strict=True):
            row[:9] = frame_around(normal / np.linalg.norm(normal)).ravel(order="F")
        packed[1:, 12] = self.offsets + packed[1:, 6:9] @ self.position
        return packed

    def corners(self) -> Array:
        """Corners of the hull in the world, (v, 3), m."""
        world: Array = self.vertices @ self.rotation.T + self.position
        return world

    def bounds(self) -> Array:
        """Least and greatest coordinates in the world, (2, 3), m."""
        corners = self.corners()
        return np.stack([corners.min(axis=0), corners.max(axis=0)])


def _hull(points: Array, name: str) -> dict[str, Any]:
    """Corners, triangles and facets of the convex hull of points (n, 3)."""
    from scipy.spatial import ConvexHull, QhullError

    try:
        hull = ConvexHull(points)
    except (QhullError, ValueError):
        message = f"the vertices of {name} lie in a plane; give a thin box instead"
        raise ProblemError("path", message) from None
    used = np.unique(hull.simplices)
    index = np.zeros(len(points), dtype=np.int64)
    index[used] = np.arange(len(used))
    triangles = index[hull.simplices]
    corners = points[used]
    edges = corners[triangles]
    turned = np.cross(edges[:, 1] - edges[:, 0], edges[:, 2] - edges[:, 0])
    inward = np.einsum("ij,ij->i", turned, hull.equations[:, :3]) < 0.0
    triangles[inward] = triangles[inward][:, ::-1]
    normals = _unlike(np.concatenate([hull.equations[:, :3], _bevels(hull)]))
    return {
        "vertices": corners,
        "triangles": triangles,
        "normals": normals,
        "offsets": (normals @ points.T).max(axis=1),
    }


def _unlike(normals: Array) -> Array:
    """Different normals, in their order."""
    decimals = round(-np.log10(SAME_PLANE))
    _, first = np.unique(normals.round(decimals), axis=0, return_index=True)
    return np.asarray(normals[np.sort(first)])


def _bevels(hull: Any) -> Array:
    """Unit normals across sharp edges and corners, (k, 3)."""
    normals = hull.equations[:, :3]
    a, b = np.repeat(np.arange(len(normals)), 3), hull.neighbors.ravel()
    sharp = np.einsum("ij,ij->i", normals[a], normals[b]) < SHARP
    sums = [normals[a[sharp]] + normals[b[sharp]]]
    for corner in np.unique(hull.simplices[a[sharp]]):
        around = _unlike(normals[np.any(hull.simplices == corner, axis=1)])
        if len(around) > 2:
            sums.append(around.sum(axis=0)[None])
    rows = np.concatenate(sums)
    length = np.linalg.norm(rows, axis=1)
    return np.asarray(rows[length > 1e-3] / length[length > 1e-3, None])
