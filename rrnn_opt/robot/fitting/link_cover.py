"""The balls of one link, piece by piece of its geometry, and how to refine them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.robot.cover import cover_box, cover_cylinder
from rrnn_opt.robot.fitting.cover_proof import uncovered
from rrnn_opt.robot.fitting.geometry import Geometry
from rrnn_opt.robot.fitting.solid_cover import (
    Burden,
    Part,
    Surface,
    halves,
    solid_parts,
)
from rrnn_opt.robot.tree import Array


@dataclass(frozen=True)
class LinkCover:
    """How a link was covered.

    Attributes:
        link: its name.
        balls: (center (3,), radius), m, in the link's frame.
        inflation: how far they bulge out of the geometry, m.
        uncovered: triangles of its meshes that are not shown to be covered.
        triangles: of its meshes.
    """

    link: str
    balls: tuple[tuple[Array, float], ...]
    inflation: float
    uncovered: int
    triangles: int


class PieceCover:
    """Balls that hold a piece of geometry, in the piece's own axes.

    A primitive has balls of one size inside it.  When they are to be refined, it
    becomes a surface like a mesh: a box exactly, a cylinder as the prism about it.

    Args:
        piece: the geometry.
        inflation: wanted bulge, m.
        most: balls at most.
    """

    def __init__(self, piece: Geometry, inflation: float, most: int) -> None:
        self.piece = piece
        self.vertices, self.triangles = piece.vertices, piece.triangles
        self._surface: Surface | None = None
        self._inflation = inflation
        if piece.kind == "mesh":
            self._surface = Surface(self.vertices, self.triangles)
            self.parts = solid_parts(self._surface, inflation, most)
        elif piece.kind == "sphere":
            self.parts = _plain(np.zeros((1, 3)), piece.size[0], 0.0)
        elif piece.kind == "cylinder":
            tube = cover_cylinder(*piece.size, inflation=inflation, most=most)
            self.parts = _plain(tube.centers, tube.radius, tube.inflation)
        else:
            box = cover_box(piece.size, inflation=inflation, most=most)
            self.parts = _plain(box.centers, box.radius, box.inflation)
        self._most = max(part.bulge for part in self.parts)

    def refine(self, index: int, burden: Burden) -> None:
        """One ball more: the ball of a part makes way for those of its halves.

        No ball comes to bulge more than the worst one did before.

        Args:
            index: of the ball.
            burden: to be made small, of a ball in the link's frame.
        """
        if self._surface is not None:
            rotation, origin = self.piece.pose[:3, :3], self.piece.pose[:3, 3]
            self.parts[index : index + 1] = halves(
                self.parts[index],
                self._surface,
                lambda center, radius: burden(rotation @ center + origin, radius),
                self._most,
            )
            return
        self.vertices, self.triangles = _faces(self.piece)
        self._surface = Surface(self.vertices, self.triangles)
        least = min(self._inflation, 0.5 * self.parts[index].bulge)
        self.parts = solid_parts(self._surface, least, len(self.parts) + 1)

    def placed(self) -> tuple[Array, Array]:
        """Centres (n, 3) in the link's frame and radii (n,), m."""
        rotation, origin = self.piece.pose[:3, :3], self.piece.pose[:3, 3]
        centers = np.array([part.center for part in self.parts]) @ rotation.T + origin
        return centers, np.array([part.radius for part in self.parts])

    def uncovered(self) -> int:
        """Triangles that are not shown to lie in the balls."""
        centers = np.array([part.center for part in self.parts])
        radii = np.array([part.radius for part in self.parts])
        return len(uncovered(self.vertices, self.triangles, centers, radii))


class CoveredLink:
    """Balls that hold a link.

    Args:
        name: of the link.
        pieces: of its geometry.
        inflation: wanted bulge, m.
        most: balls a piece, at most.
    """

    def __init__(
        self, name: str, pieces: list[Geometry], inflation: float, most: int
    ) -> None:
        self.name = name
        self.pieces = [PieceCover(piece, inflation, most) for piece in pieces]

    def placed(self) -> tuple[Array, Array]:
        """Centres (n, 3) in the link's frame and radii (n,), m."""
        both = [piece.placed() for piece in self.pieces]
        return np.concatenate([c for c, _ in both]), np.concatenate(
            [r for _, r in both]
        )

    def bulges(self) -> Array:
        """How far each ball comes out of the geometry, (n,), m."""
        return np.array([part.bulge for piece in self.pieces for part in piece.parts])

    def refine(self, index: int, burden: Burden) -> None:
        """Refine the piece that the ball ``index`` belongs to, at that ball."""
        for piece in self.pieces:
            if index < len(piece.parts):
                piece.refine(index, burden)
                return
            index -= len(piece.parts)

    def cover(self) -> LinkCover:
        """What was made, with the proof that it covers."""
        centers, radii = self.placed()
        return LinkCover(
            self.name,
            tuple((c, float(r)) for c, r in zip(centers, radii, strict=True)),
            float(self.bulges().max()),
            sum(piece.uncovered() for piece in self.pieces),
            sum(len(piece.triangles) for piece in self.pieces),
        )


def _plain(centers: Array, radius: float, bulge: float) -> list[Part]:
    none = np.zeros((0, 3, 3))
    return [Part(none, center, radius, bulge) for center in centers]


def _faces(piece: Geometry) -> tuple[Array, NDArray[np.int64]]:
    """Hull of a primitive's corners as vertices and outward triangles."""
    from scipy.spatial import ConvexHull

    points = piece.corners()
    hull = ConvexHull(points)
    triangles = hull.simplices.astype(np.int64)
    a, b, c = (points[triangles[:, k]] for k in range(3))
    inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), hull.equations[:, :3]) < 0.0
    triangles[inward] = triangles[inward][:, ::-1]
    return points, triangles
