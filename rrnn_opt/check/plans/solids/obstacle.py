"""Obstacles as a problem states them, read and refused if malformed."""

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


@dataclass(frozen=True, eq=False)
class Obstacle:
    """An obstacle, convex but for a cloud.

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
