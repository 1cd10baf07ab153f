"""Signed distance of points to convex obstacles, and half-spaces that hold them.

``gap`` is what proofs rest on: for *any* unit n the obstacle lies in the
half-space ``n.x <= support(n)``, so a poor normal weakens a bound but never
falsifies it.  Signed distances only propose n and refute.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rrnn_opt.check import reading
from rrnn_opt.check.reading import Array, get
from rrnn_opt.errors import DocumentError


@dataclass(frozen=True, eq=False)
class Obstacle:
    """A convex obstacle.

    Attributes:
        name: as in the problem file.
        kind: "box", "cylinder", "capsule", "sphere" or "halfspace".
        rotation: its axes as columns, (3, 3); a half-space has its normal third.
        position: (3,), m.
        dims: box: half edges; cylinder, capsule: radius and half length;
            sphere: radius; half-space: offset, m.
    """

    name: str
    kind: str
    rotation: Array
    position: Array
    dims: Array


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
    turned = entry.get("quat_xyzw")
    rotation = np.eye(3)
    if turned is not None:
        rotation = reading.quaternion(turned, f"{name}.quat_xyzw")
    position = reading.numbers(get(entry, "position", name), (3,), f"{name}.position")
    return Obstacle(label, kind, rotation, position, _read_dims(entry, kind, name))


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


def signed_distance(obstacle: Obstacle, points: Array) -> tuple[Array, Array]:
    """Distance of points to the solid (negative inside) and outward normals.

    Args:
        obstacle: the solid.
        points: world positions, (M, 3), m.

    Returns:
        d (M,) in m, n (M, 3) of unit length; at centres and edges one of the
        possible normals.
    """
    if obstacle.kind == "halfspace":
        normal = obstacle.rotation[:, 2]
        n = np.broadcast_to(normal, points.shape)
        return points @ normal - obstacle.dims[0], n
    local = (points - obstacle.position) @ obstacle.rotation
    if obstacle.kind == "box":
        d, n = _box(local, obstacle.dims)
    elif obstacle.kind == "cylinder":
        d, n = _cylinder(local, obstacle.dims)
    else:
        d, n = _rounded(local, obstacle.dims)
    return d, n @ obstacle.rotation.T


def _box(local: Array, half: Array) -> tuple[Array, Array]:
    over = np.abs(local) - half
    out = np.maximum(over, 0.0)
    far = np.sqrt(np.einsum("ij,ij->i", out, out))
    deepest = np.argmax(over, axis=1)
    rows = np.arange(len(local))
    outside = far > 0
    n = np.zeros_like(local)
    n[rows, deepest] = 1.0
    n[outside] = out[outside] / far[outside, None]
    d = np.where(outside, far, over[rows, deepest])
    return d, np.where(local < 0, -n, n)


def _cylinder(local: Array, dims: Array) -> tuple[Array, Array]:
    rho = np.hypot(local[:, 0], local[:, 1])
    flat = np.stack([rho, local[:, 2]], axis=1)
    d, m = _box(flat, dims)
    safe = np.where(rho > 0, rho, 1.0)
    across = np.where(rho > 0, local[:, 0] / safe, 1.0)
    along = np.where(rho > 0, local[:, 1] / safe, 0.0)
    return d, np.stack([m[:, 0] * across, m[:, 0] * along, m[:, 1]], axis=1)


def _rounded(local: Array, dims: Array) -> tuple[Array, Array]:
    """A sphere, or a capsule: all points within a radius of a segment."""
    away = local.copy()
    if len(dims) == 2:
        away[:, 2] -= np.clip(local[:, 2], -dims[1], dims[1])
    far = np.sqrt(np.einsum("ij,ij->i", away, away))
    n = away / np.where(far > 0, far, 1.0)[:, None]
    n[far == 0] = (1.0, 0.0, 0.0)
    return far - dims[0], n


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
        return signed_distance(obstacle, points)[0]
    beyond: Array = np.einsum("ij,ij->i", n, points - obstacle.position)
    return beyond - _support(obstacle, np.abs(n @ obstacle.rotation))


def _support(obstacle: Obstacle, n: Array) -> Array:
    """Support function about the centre, for |n| in local axes, (M,), m."""
    if obstacle.kind == "box":
        return np.asarray(n @ obstacle.dims)
    if obstacle.kind == "sphere":
        return np.asarray(np.linalg.norm(n, axis=1) * obstacle.dims[0])
    across = n[:, :2] if obstacle.kind == "cylinder" else n
    radius = np.linalg.norm(across, axis=1) * obstacle.dims[0]
    return np.asarray(radius + n[:, 2] * obstacle.dims[1])
