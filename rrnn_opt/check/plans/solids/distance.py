"""Signed distance of points to convex obstacles, and half-spaces that hold them.

``gap`` is what proofs rest on: for *any* unit n the obstacle lies in the
half-space ``n.x <= support(n)``, so a poor normal weakens a bound but never
falsifies it.  Signed distances only propose n and refute.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rrnn_opt.check.plans import reading
from rrnn_opt.check.plans.reading import Array, get
from rrnn_opt.check.plans.solids.cloud import Cloud
from rrnn_opt.check.plans.solids.files import read_points
from rrnn_opt.check.plans.solids.hull import Hull
from rrnn_opt.errors import DocumentError

TINY = 1e-100
"""Vectors shorter than this, m, are not divided by their length: any direction
will do, and none may lose its unit length to underflow."""


@dataclass(frozen=True, eq=False)
class Obstacle:
    """An obstacle, convex but for a cloud.

    No half-space holds a cloud tightly: ``gap`` says minus infinity there, and
    its distances alone prove and refute.

    Attributes:
        name: as in the problem file.
        kind: "box", "cylinder", "capsule", "sphere", "halfspace", "mesh" or
            "points".
        rotation: its axes as columns, (3, 3); a half-space has its normal third.
        position: (3,), m.
        dims: box: half edges; cylinder, capsule: radius and half length;
            sphere: radius; half-space: offset; mesh: largest coordinate;
            points: radius and largest coordinate, m.
        matter: what a mesh or a cloud is made of.
    """

    name: str
    kind: str
    rotation: Array
    position: Array
    dims: Array
    matter: Hull | Cloud | None = None

    @property
    def size(self) -> float:
        """Distance from the origin plus its own dimensions, m: for rounding."""
        return float(np.abs(self.position).sum() + np.abs(self.dims).sum())


def read_obstacle(value: Any, name: str) -> Obstacle:
    """An entry of "obstacles".

    Raises:
        DocumentError: a field is missing or malformed, or the type is unknown.
    """
    entry = reading.mapping(value, name)
    kind = reading.text(get(entry, "type", name), f"{name}.type")
    label = str(entry.get("name", name))
    if kind == "halfspace":
        return _read_halfspace(entry, name, label)
    if kind == "points":
        return _read_cloud(entry, name, label)
    turned = entry.get("quat_xyzw")
    rotation = np.eye(3)
    if turned is not None:
        rotation = reading.quaternion(turned, f"{name}.quat_xyzw")
    given = entry.get("position", [0, 0, 0] if kind == "mesh" else None)
    position = reading.numbers(given, (3,), f"{name}.position")
    if kind == "mesh":
        scale = reading.positive(entry.get("scale", 1.0), f"{name}.scale")
        hull = Hull(scale * read_points(entry, name), name)
        return Obstacle(label, kind, rotation, position, np.array([hull.size]), hull)
    return Obstacle(label, kind, rotation, position, _read_dims(entry, kind, name))


def _read_cloud(entry: Any, name: str, label: str) -> Obstacle:
    cloud = Cloud(read_points(entry, name))
    radius = reading.positive(get(entry, "radius", name), f"{name}.radius")
    dims = np.array([radius, cloud.size])
    return Obstacle(label, "points", np.eye(3), np.zeros(3), dims, cloud)


def _read_dims(entry: Any, kind: str, name: str) -> Array:
    if kind == "box":
        size = reading.numbers(get(entry, "size", name), (3,), f"{name}.size")
        if np.any(size <= 0):
            raise DocumentError(f"{name}.size", "must be positive")
        return size / 2
    if kind not in ("cylinder", "capsule", "sphere"):
        raise DocumentError(f"{name}.type", f"'{kind}' cannot be judged here")
    radius = reading.positive(get(entry, "radius", name), f"{name}.radius")
    if kind == "sphere":
        return np.array([radius])
    length = reading.number(get(entry, "length", name), f"{name}.length")
    if length < 0 or (length == 0 and kind == "cylinder"):
        raise DocumentError(f"{name}.length", "must be positive")
    return np.array([radius, length / 2])


def _read_halfspace(entry: Any, name: str, label: str) -> Obstacle:
    normal = reading.numbers(get(entry, "normal", name), (3,), f"{name}.normal")
    length = float(np.sqrt(normal @ normal))
    if abs(length - 1.0) > 1e-6:
        raise DocumentError(f"{name}.normal", "must be of unit length")
    offset = reading.number(get(entry, "offset", name), f"{name}.offset")
    axes = np.zeros((3, 3))
    axes[:, 2] = normal / length
    return Obstacle(label, "halfspace", axes, np.zeros(3), np.array([offset / length]))


def signed_distance(obstacle: Obstacle, points: Array) -> Array:
    """Distance of points to the solid, negative inside.

    Args:
        obstacle: the solid.
        points: world positions, (M, 3), m.

    Returns:
        (M,), m.
    """
    if obstacle.kind == "halfspace":
        return np.asarray(points @ obstacle.rotation[:, 2] - obstacle.dims[0])
    local = (points - obstacle.position) @ obstacle.rotation
    if obstacle.matter is not None:
        d = obstacle.matter.nearest(local)[0]
        return d - obstacle.dims[0] if obstacle.kind == "points" else d
    if obstacle.kind == "box":
        return _box(local, obstacle.dims)
    if obstacle.kind == "cylinder":
        return _box(_meridian(local), obstacle.dims)
    far = _lengths(_from_core(local, obstacle.dims))
    return np.asarray(far - obstacle.dims[0])


def normals(obstacle: Obstacle, points: Array) -> Array:
    """Outward unit normals where the solid is nearest, (M, 3), world axes.

    At centres and edges one of the possible normals.

    Args:
        obstacle: the solid.
        points: world positions, (M, 3), m.
    """
    if obstacle.kind == "halfspace":
        return np.broadcast_to(obstacle.rotation[:, 2], points.shape)
    local = (points - obstacle.position) @ obstacle.rotation
    if obstacle.matter is not None:
        n = obstacle.matter.nearest(local)[1]
    elif obstacle.kind == "box":
        n = _box_normals(local, obstacle.dims)
    elif obstacle.kind == "cylinder":
        flat = _meridian(local)
        m, off_axis = _box_normals(flat, obstacle.dims), flat[:, :1] > TINY
        out = local[:, :2] / np.where(off_axis, flat[:, :1], 1.0)
        out = np.where(off_axis, out, (1.0, 0.0))
        n = np.concatenate([m[:, :1] * out, m[:, 1:]], axis=1)
    else:
        away = _from_core(local, obstacle.dims)
        far = _lengths(away)[:, None]
        n = np.where(far > TINY, away / np.where(far > TINY, far, 1.0), (1.0, 0.0, 0.0))
    return np.asarray(n @ obstacle.rotation.T)


def _lengths(rows: Array) -> Array:
    return np.asarray(np.sqrt(np.einsum("ij,ij->i", rows, rows)))


def _box(local: Array, half: Array) -> Array:
    over = np.abs(local) - half
    most = np.maximum(over[:, 0], over[:, -1])
    if over.shape[1] == 3:
        most = np.maximum(most, over[:, 1])
    return np.asarray(_lengths(np.maximum(over, 0.0)) + np.minimum(most, 0.0))


def _box_normals(local: Array, half: Array) -> Array:
    over = np.abs(local) - half
    out = np.maximum(over, 0.0)
    far = _lengths(out)[:, None]
    nearest = np.eye(local.shape[1])[np.argmax(over, axis=1)]
    n = np.where(far > TINY, out / np.where(far > TINY, far, 1.0), nearest)
    return np.where(local < 0, -n, n)


def _meridian(local: Array) -> Array:
    """Distance from the axis, and height along it, (M, 2)."""
    return np.stack([_lengths(local[:, :2]), local[:, 2]], axis=1)


def _from_core(local: Array, dims: Array) -> Array:
    """Vectors from the centre of a sphere, or the segment of a capsule, (M, 3)."""
    away = local.copy()
    if len(dims) == 2:
        away[:, 2] -= np.clip(local[:, 2], -dims[1], dims[1])
    return away


def gap(obstacle: Obstacle, points: Array, n: Array) -> Array:
    """``n.p - support(n)``: how far p lies beyond the half-space that n defines.

    Never more than the signed distance, whatever unit vectors n are.

    Args:
        obstacle: the solid.
        points: (M, 3), m.
        n: unit vectors, (M, 3); a half-space takes its own normal instead.

    Returns:
        (M,), m.
    """
    if obstacle.kind == "halfspace":
        return signed_distance(obstacle, points)
    beyond: Array = np.einsum("ij,ij->i", n, points - obstacle.position)
    if isinstance(obstacle.matter, Hull):
        return beyond - obstacle.matter.support(n @ obstacle.rotation)
    if isinstance(obstacle.matter, Cloud):
        return np.full(len(points), -np.inf)
    return beyond - _support(obstacle, np.abs(n @ obstacle.rotation))


def _support(obstacle: Obstacle, n: Array) -> Array:
    """Support function about the centre, for |n| in local axes, (M,), m."""
    if obstacle.kind == "box":
        return np.asarray(n @ obstacle.dims)
    if obstacle.kind == "sphere":
        return np.asarray(_lengths(n) * obstacle.dims[0])
    across = n[:, :2] if obstacle.kind == "cylinder" else n
    radius = _lengths(across) * obstacle.dims[0]
    return np.asarray(radius + n[:, 2] * obstacle.dims[1])
