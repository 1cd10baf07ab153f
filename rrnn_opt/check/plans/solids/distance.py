"""Signed distance of points to convex obstacles, and half-spaces that hold them.

``gap`` is what proofs rest on: for *any* unit n the obstacle lies in the
half-space ``n.x <= support(n)``, so a poor normal weakens a bound but never
falsifies it.  Signed distances only propose n and refute.  Everything is said in
the solid's own axes, and of many solids of one kind at once.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.check.plans.reading import Array
from rrnn_opt.check.plans.solids.cloud import Cloud
from rrnn_opt.check.plans.solids.hull import Hull
from rrnn_opt.check.plans.solids.obstacle import Obstacle

Index = NDArray[np.int64]
TINY = 1e-100
"""Vectors shorter than this, m, are not divided by their length: any direction
will do, and none may lose its unit length to underflow."""


@dataclass(frozen=True, eq=False)
class Solids:
    """Obstacles of one kind, side by side; a mesh or a cloud stands alone.

    No half-space holds a cloud tightly: ``gap`` says minus infinity there, and
    its distances alone prove and refute.

    Attributes:
        kind: as in :class:`Obstacle`.
        names: of each.
        turns: from the world's axes to each one's own, (O, 3, 3).
        columns: the same, the solids last, (3, 3, O).
        positions: (3, O), m.
        dims: as in :class:`Obstacle`, (k, O), m.
        sizes: see ``Obstacle.size``, (O,), m.
        matter: what the mesh or cloud is made of.
    """

    kind: str
    names: tuple[str, ...]
    turns: Array
    columns: Array
    positions: Array
    dims: Array
    sizes: Array
    matter: Hull | Cloud | None

    @staticmethod
    def of(obstacles: Sequence[Obstacle]) -> Solids:
        """Obstacles of one kind; one alone where it has matter."""
        turns = np.stack([o.rotation.T for o in obstacles])
        return Solids(
            obstacles[0].kind,
            tuple(o.name for o in obstacles),
            turns,
            np.ascontiguousarray(np.moveaxis(turns, 0, 2)),
            np.stack([o.position for o in obstacles], axis=1),
            np.stack([o.dims for o in obstacles], axis=1),
            np.array([o.size for o in obstacles]),
            obstacles[0].matter,
        )

    def local(self, points: Array, which: Index) -> Array:
        """World positions (3, M) in the axes of one solid each, (3, M), m."""
        away = points - self.positions.take(which, axis=1)
        local: Array = (self.columns.take(which, axis=2) * away).sum(axis=1)
        return local

    def every_distance(self, points: Array) -> Array:
        """Signed distance of each solid to all points (3, N), (O, N), m."""
        local = self.turns @ (points - self.positions.T[:, :, None])
        return self._signed(local.swapaxes(0, 1), self.dims[:, :, None])

    def distance(self, points: Array, which: Index) -> Array:
        """Signed distance of points (3, M) to one solid each, (M,), m."""
        return self._signed(self.local(points, which), self.dims.take(which, axis=1))

    def facing(self, points: Array, which: Index) -> tuple[Array, Array]:
        """The half-space that holds the solid where it is nearest.

        Args:
            points: world positions, (3, M), m.
            which: the solid of each, (M,).

        Returns:
            How far the point lies beyond it, (M,), m, never more than the signed
            distance; and its outward normal in world axes, (3, M).
        """
        local = self.local(points, which)
        n = self.normals(local, which)
        outward = (self.columns.take(which, axis=2) * n[:, None]).sum(axis=0)
        return self.gap(local, n, which), outward

    def normals(self, local: Array, which: Index) -> Array:
        """Outward unit normals where the solid is nearest, own axes, (3, M).

        At centres and edges one of the possible normals.
        """
        if self.kind == "halfspace":
            return np.repeat([[0.0], [0.0], [1.0]], len(which), axis=1)
        if self.matter is not None:
            return self.matter.nearest(local.T)[1].T
        dims = self.dims.take(which, axis=1)
        if self.kind == "box":
            return _box_normals(local, dims)
        if self.kind == "cylinder":
            flat = _meridian(local)
            m, off_axis = _box_normals(flat, dims), flat[0] > TINY
            out = local[:2] / np.where(off_axis, flat[0], 1.0)
            out = np.where(off_axis, out, [[1.0], [0.0]])
            return np.concatenate([m[:1] * out, m[1:]])
        away = _from_core(local, dims)
        return _unit(away, np.array([[1.0], [0.0], [0.0]]))

    def gap(self, local: Array, n: Array, which: Index) -> Array:
        """``n.p - support(n)``: how far p lies beyond the half-space of n.

        Never more than the signed distance, whatever unit vectors n are.

        Args:
            local: points in the solids' own axes, (3, M), m.
            n: unit vectors, own axes, (3, M); a half-space takes its own instead.
            which: the solid of each, (M,).

        Returns:
            (M,), m.
        """
        dims = self.dims.take(which, axis=1)
        if self.kind == "halfspace":
            return self._signed(local, dims)
        if isinstance(self.matter, Cloud):
            return np.full(len(which), -np.inf)
        beyond: Array = (n * local).sum(axis=0)
        if isinstance(self.matter, Hull):
            return beyond - self.matter.support(n.T)
        return beyond - self._support(np.abs(n), dims)

    def _signed(self, local: Array, dims: Array) -> Array:
        if self.matter is not None:
            rows = np.moveaxis(local, 0, -1)
            d = self.matter.nearest(rows.reshape(-1, 3))[0].reshape(rows.shape[:-1])
            return d - dims[0] if self.kind == "points" else d
        if self.kind == "halfspace":
            return np.asarray(local[2] - dims[0])
        if self.kind == "box":
            return _box(local, dims)
        if self.kind == "cylinder":
            return _box(_meridian(local), dims)
        return np.asarray(_lengths(_from_core(local, dims)) - dims[0])

    def _support(self, n: Array, dims: Array) -> Array:
        """Support function about the centre, for |n| in own axes, (M,), m."""
        if self.kind == "box":
            return np.asarray((n * dims).sum(axis=0))
        if self.kind == "sphere":
            return np.asarray(_lengths(n) * dims[0])
        across = n[:2] if self.kind == "cylinder" else n
        return np.asarray(_lengths(across) * dims[0] + n[2] * dims[1])


def _lengths(columns: Array) -> Array:
    return np.asarray(np.sqrt((columns * columns).sum(axis=0)))


def _unit(columns: Array, instead: Array) -> Array:
    """Columns over their lengths; ``instead`` where one is too short for that."""
    far = _lengths(columns)
    usual = far > TINY
    return np.where(usual, columns / np.where(usual, far, 1.0), instead)


def _box(local: Array, half: Array) -> Array:
    over = np.abs(local)
    over -= half
    inside = np.minimum(over.max(axis=0), 0.0)
    return np.asarray(_lengths(np.maximum(over, 0.0)) + inside)


def _box_normals(local: Array, half: Array) -> Array:
    over = np.abs(local) - half
    nearest = np.eye(len(local))[:, np.argmax(over, axis=0)]
    n = _unit(np.maximum(over, 0.0), nearest)
    return np.where(local < 0, -n, n)


def _meridian(local: Array) -> Array:
    """Distance from the axis, and height along it, (2, ...)."""
    return np.stack([_lengths(local[:2]), local[2]])


def _from_core(local: Array, dims: Array) -> Array:
    """Vectors from the centre of a sphere, or the segment of a capsule, (3, ...)."""
    if len(dims) == 1:
        return local
    away = local.copy()
    away[2] -= np.clip(local[2], -dims[1], dims[1])
    return away
