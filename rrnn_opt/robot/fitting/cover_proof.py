"""Proof that spheres contain a surface, which knows nothing of how they were fitted.

A triangle whose corners lie in one ball lies in it whole.  One that does not is
cut into four until every piece is held by a ball; what is still open at the
last depth, or when there are too many pieces, is returned as not covered.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.robot.tree import Array

DEPTH = 14
MOST_PIECES = 400_000
"""Open pieces beyond which no more are cut."""
_CHUNK = 20_000


def uncovered(
    vertices: Array,
    triangles: NDArray[np.int64],
    centers: Array,
    radii: Array,
    *,
    depth: int = DEPTH,
) -> NDArray[np.int64]:
    """Triangles that are not shown to lie in the union of the spheres.

    Args:
        vertices: (v, 3), m.
        triangles: vertex indices, (t, 3).
        centers: (n, 3), m.
        radii: (n,), m.
        depth: how often a triangle is cut into four at most.

    Returns:
        Their indices; none when the union contains the surface.
    """
    corners = np.asarray(vertices, dtype=np.float64)[triangles]
    owner = np.arange(len(corners))
    for level in range(depth + 1):
        chunks = range(0, len(corners), _CHUNK)
        held = [_held(corners[i : i + _CHUNK], centers, radii) for i in chunks]
        left = ~np.concatenate(held) if held else np.zeros(0, dtype=bool)
        corners, owner = corners[left], owner[left]
        if not len(corners) or level == depth or len(corners) > MOST_PIECES // 4:
            break
        corners, owner = _quarters(corners), np.repeat(owner, 4)
    return np.unique(owner)


def _held(corners: Array, centers: Array, radii: Array) -> NDArray[np.bool_]:
    """Which triangles (t, 3, 3) have all corners in one ball."""
    inside = np.ones((len(corners), len(radii)), dtype=bool)
    for k in range(3):
        away = corners[:, None, k] - centers
        inside &= np.einsum("tni,tni->tn", away, away) <= radii * radii
    return np.asarray(inside.any(axis=1))


def _quarters(corners: Array) -> Array:
    a, b, c = (corners[:, k] for k in range(3))
    ab, bc, ca = 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)
    pieces = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    stacked = np.stack([np.stack(piece, axis=1) for piece in pieces], axis=1)
    return np.asarray(stacked.reshape(-1, 3, 3))
