"""The collision geometry of a URDF as triangles; only here is coal known.

Meshes are loaded by coal (any format that assimp reads, URDF's ``scale``
applied); spheres, cylinders and boxes stay what they are.
"""

from __future__ import annotations

import math
import os
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.errors import RobotError
from rrnn_opt.robot.loading.urdf import Urdf
from rrnn_opt.robot.loading.urdf_shapes import SIZES, floats, read_primitive
from rrnn_opt.robot.placement import compose, shift, turn
from rrnn_opt.robot.tree import Array

SIDES = 32
"""Of the prism about a cylinder, which is 0.5 % wider."""


@dataclass(frozen=True, eq=False)
class Geometry:
    """A piece of a link's collision geometry.

    Attributes:
        kind: "mesh", "sphere", "cylinder" or "box".
        size: radius; radius and length; three edges; nothing for a mesh; m.
        pose: in the link's frame, (4, 4), m.
        vertices: of a mesh, in its own axes, scaled, (v, 3), m.
        triangles: vertex indices, (t, 3).
    """

    kind: str
    size: tuple[float, ...]
    pose: Array
    vertices: Array
    triangles: NDArray[np.int64]

    def corners(self) -> Array:
        """Points, in the piece's own axes, whose hull holds it, (n, 3), m.

        Corners of a box, of the prism about a cylinder and of a sphere's cube;
        the vertices of a mesh.
        """
        if self.kind == "mesh":
            return self.vertices
        if self.kind == "cylinder":
            radius, length = self.size
            turn = 2 * np.pi * np.arange(SIDES) / SIDES
            wide = (1.0 + 1e-12) * radius / np.cos(np.pi / SIDES)
            ring = wide * np.stack([np.cos(turn), np.sin(turn)], axis=1)
            ends = (-0.5 * length, 0.5 * length)
            return np.concatenate([np.c_[ring, np.full(SIDES, z)] for z in ends])
        edges = self.size if self.kind == "box" else (2 * self.size[0],) * 3
        signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T
        return np.asarray(0.5 * signs * np.array(edges))

    def extremes(self) -> Array:
        """``corners`` in the link's frame, (n, 3), m."""
        return self.corners() @ self.pose[:3, :3].T + self.pose[:3, 3]


def collision_geometry(
    urdf: Urdf, folders: tuple[Path, ...] = ()
) -> tuple[dict[str, list[Geometry]], list[str]]:
    """Geometry of every link that has any.

    A link without collision geometry gives its visual geometry.

    Args:
        urdf: the checked file.
        folders: where ``package://`` paths may start, besides the folders
            above the file and those of ROS_PACKAGE_PATH.

    Returns:
        Geometry by link, and the links whose visual geometry was taken.

    Raises:
        RobotError: a mesh is not there or cannot be read.
    """
    found: dict[str, list[Geometry]] = {}
    visual: list[str] = []
    for link in ET.fromstring(urdf.text).findall("link"):
        name, elements = link.attrib["name"], link.findall("collision")
        if not elements:
            elements = link.findall("visual")
            visual += [name] if elements else []
        if elements:
            try:
                found[name] = [_geometry(e, urdf, folders) for e in elements]
            except (KeyError, ValueError) as error:
                message = f"geometry of link '{name}' is malformed: {error}"
                raise RobotError(urdf.path, message) from None
    return found, visual


def _geometry(element: ET.Element, urdf: Urdf, folders: tuple[Path, ...]) -> Geometry:
    pose = _pose(element.find("origin"))
    none, faces = np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64)
    for kind in SIZES:
        shape = element.find(f"geometry/{kind}")
        if shape is not None:
            primitive = read_primitive(element)
            return Geometry(kind, primitive.size, pose, none, faces)
    mesh = element.find("geometry/mesh")
    if mesh is None or "filename" not in mesh.attrib:
        raise RobotError(urdf.path, "a geometry is neither a mesh nor a known shape")
    scale = np.array(floats(mesh.get("scale", "1 1 1"), 3))
    path = mesh_path(mesh.attrib["filename"], Path(urdf.path), folders)
    vertices, triangles = load_mesh(path, scale)
    return Geometry("mesh", (), pose, vertices, triangles)


def _pose(origin: ET.Element | None) -> Array:
    given = {} if origin is None else origin.attrib
    x, y, z = floats(given.get("xyz", "0 0 0"), 3)
    roll, pitch, yaw = map(math.degrees, floats(given.get("rpy", "0 0 0"), 3))
    return compose(shift(x, y, z), turn("z", yaw), turn("y", pitch), turn("x", roll))


def mesh_path(reference: str, urdf: Path, folders: tuple[Path, ...]) -> Path:
    """Where a mesh that a URDF names lies.

    Raises:
        RobotError: it is in none of the folders.
    """
    plain = reference.removeprefix("file://")
    if "://" not in plain:
        candidates = [urdf.parent / plain]
    else:
        inside = plain.split("://", 1)[1]
        ros = os.environ.get("ROS_PACKAGE_PATH", "").split(os.pathsep)
        roots = [*folders, *urdf.resolve().parents, *(Path(p) for p in ros if p)]
        within = Path(*Path(inside).parts[1:])
        candidates = [root / part for root in roots for part in (inside, within)]
    for candidate in candidates:
        try:
            if candidate.is_file():
                return candidate
        except (OSError, ValueError):  # a name that no file can have
            continue
    message = f"there is no mesh '{reference}'; name its package's parent folder"
    raise RobotError(str(urdf), f"{message} with --package-dir")


def load_mesh(path: Path, scale: Array) -> tuple[Array, NDArray[np.int64]]:
    """Vertices (v, 3) and triangles (t, 3) of a mesh file, through coal.

    Raises:
        RobotError: it cannot be read, or has no triangles.
    """
    import coal

    try:
        model = coal.MeshLoader().load(str(path), np.asarray(scale, dtype=np.float64))
    except (ValueError, RuntimeError) as error:
        reason = str(error).strip().splitlines()
        why = reason[0] if reason else "no reason given"
        raise RobotError(str(path), f"no readable mesh: {why}") from None
    vertices = np.array(model.vertices(), dtype=np.float64).reshape(-1, 3)
    faces = [model.tri_indices(i) for i in range(model.num_tris)]
    triangles = np.array([[f[0], f[1], f[2]] for f in faces], dtype=np.int64)
    if not len(triangles) or not np.all(np.isfinite(vertices)):
        raise RobotError(str(path), "has no triangles of finite vertices")
    return vertices, triangles


class Gap:
    """Geometry of two links, of which coal tells how far apart it is.

    Args:
        first: geometry of one link.
        second: of the other.
    """

    def __init__(self, first: list[Geometry], second: list[Geometry]) -> None:
        self._pairs = [
            (_solid(one), one.pose, _solid(other), other.pose)
            for one, other in product(first, second)
        ]

    def touching(self, first: Array, second: Array) -> bool:
        """Whether they touch where the links' frames are at poses (4, 4), m."""
        import coal

        for one, at, other, there in self._pairs:
            request, result = coal.CollisionRequest(), coal.CollisionResult()
            placed = _placed(first @ at), _placed(second @ there)
            if coal.collide(one, placed[0], other, placed[1], request, result):
                return True
        return False

    def at(self, first: Array, second: Array) -> float:
        """Their distance where the links' frames are at poses (4, 4), m."""
        import coal

        return min(
            float(
                coal.distance(
                    one,
                    _placed(first @ at),
                    other,
                    _placed(second @ there),
                    coal.DistanceRequest(),
                    coal.DistanceResult(),
                )
            )
            for one, at, other, there in self._pairs
        )


def _placed(pose: Array) -> Any:
    import coal

    return coal.Transform3s(pose[:3, :3], pose[:3, 3])


def _solid(piece: Geometry) -> Any:
    """Coal's object of a piece of geometry."""
    import coal

    if piece.kind == "sphere":
        return coal.Sphere(*piece.size)
    if piece.kind == "cylinder":
        return coal.Cylinder(*piece.size)
    if piece.kind == "box":
        return coal.Box(*piece.size)
    model = coal.BVHModelOBBRSS()
    model.beginModel(len(piece.triangles), len(piece.vertices))
    corners = piece.vertices[piece.triangles]
    for a, b, c in corners:
        model.addTriangle(a, b, c)
    model.endModel()
    return model
