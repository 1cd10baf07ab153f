"""What a drawing shows of the surroundings, and from where.

Walls are often metres larger than the arm, and the ground has no end: solids
are cut to the box in which the motion takes place, in their own axes.  That
is a choice of the drawing only.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.errors import ProblemError
from rrnn_opt.report.plan import mesh
from rrnn_opt.report.plan.mesh import Mesh
from rrnn_opt.report.save import drawable
from rrnn_opt.scene.shapes import Box, Capsule, Cylinder, HalfSpace, Obstacle, Sphere

Array = NDArray[np.float64]

SHAPES: dict[str, type[Obstacle]] = {
    shape.kind: shape for shape in (Box, Cylinder, Capsule, Sphere, HalfSpace)
}


@dataclass(frozen=True, eq=False)
class Workspace:
    """The axis-aligned box that is drawn.

    Attributes:
        low: lowest corner, (3,), m.
        high: highest corner, (3,), m.
    """

    low: Array
    high: Array

    @property
    def centre(self) -> Array:
        """Its middle, (3,), m."""
        middle: Array = 0.5 * (self.low + self.high)
        return middle

    @property
    def size(self) -> float:
        """Its longest edge, m."""
        return float(np.max(self.high - self.low))

    def seen_from(self, rotation: Array, position: Array) -> tuple[Array, Array]:
        """Corners of the box around it in the axes of a solid, (3,) each."""
        picks = np.array(np.meshgrid(*[[0, 1]] * 3, indexing="ij")).reshape(3, -1).T
        corners = np.where(picks == 0, self.low, self.high)
        local = (corners - position) @ rotation
        return local.min(axis=0), local.max(axis=0)


def workspace(points: Array, *, border: float) -> Workspace:
    """The box around some points.

    Args:
        points: (n, 3), m.
        border: added on each side as a share of the longest edge.
    """
    low, high = points.min(axis=0), points.max(axis=0)
    edge = float(np.max(high - low)) or 1.0
    pad = np.maximum(border * edge, 0.5 * (0.6 * edge - (high - low)))
    padded = Workspace(low - pad, high + pad)
    if low[2] > -0.1 * edge:  # nothing goes below the floor: do not draw a cellar
        padded.low[2] = min(low[2], 0.0)
    return padded


def obstacles_of(document: dict[str, Any]) -> tuple[list[Obstacle], list[str]]:
    """The obstacles that can be drawn, and the names of the others."""
    shapes, others = [], []
    for entry in document["problem"].get("obstacles", []):
        kind = str(entry.get("type"))
        values = {key: value for key, value in entry.items() if key != "type"}
        try:
            shapes.append(SHAPES[kind](**values))
        except (KeyError, TypeError, ProblemError):
            others.append(drawable(f"{entry.get('name', '?')} ({kind})"))
    return shapes, others


def drawn(obstacle: Obstacle, space: Workspace, *, tile: float) -> Mesh:
    """The part of an obstacle's surface that lies in the workspace.

    Args:
        obstacle: any shape.
        space: what is drawn.
        tile: edge of the tiles of flat faces, m.

    Returns:
        Its mesh in world axes; without faces where nothing is to be seen.
    """
    rotation, position = obstacle.rotation, obstacle.position
    low, high = space.seen_from(rotation, position)
    local = _local(obstacle, low, high, tile)
    if local is None:
        return mesh.merged([])
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = rotation, position
    return local.moved(pose)


def _local(obstacle: Obstacle, low: Array, high: Array, tile: float) -> Mesh | None:
    if isinstance(obstacle, HalfSpace):
        inside = low[2] <= obstacle.offset <= high[2]
        grid = mesh.plate(low, high, (0, 1), tile)
        grid[..., 2] = obstacle.offset
        return mesh.surface(grid) if inside else None
    if isinstance(obstacle, Sphere):
        reach = np.full(3, obstacle.radius)
    elif isinstance(obstacle, Box):
        reach = 0.5 * obstacle.size
    else:
        half = 0.5 * obstacle.length
        cap = obstacle.radius if isinstance(obstacle, Capsule) else 0.0
        reach = np.array([obstacle.radius, obstacle.radius, half + cap])
    cut_low, cut_high = np.maximum(-reach, low), np.minimum(reach, high)
    if np.any(cut_low >= cut_high):
        return None
    if isinstance(obstacle, Box):
        return mesh.box(cut_low, cut_high, tile=tile)
    return _round(obstacle, cut_low[2], cut_high[2])


def _round(obstacle: Cylinder | Capsule | Sphere, low: float, high: float) -> Mesh:
    """A round solid, its straight part between two heights of its own axis."""
    if isinstance(obstacle, Sphere):
        return mesh.sphere(np.zeros(3), obstacle.radius, sides=20)
    if isinstance(obstacle, Cylinder):
        return mesh.cylinder_z(obstacle.radius, low, high)
    half = 0.5 * obstacle.length
    ends = np.clip([low, high], -half, half)
    return mesh.capsule_z(obstacle.radius, ends[0], ends[1], sides=20)
