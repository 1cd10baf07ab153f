"""Everything that picture and page draw, computed once from a document."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.errors import DocumentError
from rrnn_opt.report.plan.body import Part, parts_of, spheres_of
from rrnn_opt.report.plan.camera import View, best_view
from rrnn_opt.report.plan.clearance import Approach, sampled_clearance
from rrnn_opt.report.plan.form import require_plan
from rrnn_opt.report.plan.mesh import Mesh, merged
from rrnn_opt.report.plan.motion import Motion, motion_of
from rrnn_opt.report.plan.pose import joint_frames, sphere_centres, tip_positions
from rrnn_opt.report.plan.stage import Workspace, drawn, obstacles_of, workspace
from rrnn_opt.report.plan.traces import tool_traces
from rrnn_opt.scene.shapes import Obstacle

Array = NDArray[np.float64]

TILES = 16


@dataclass(frozen=True, eq=False)
class Drawing:
    """A plan result, ready to be drawn.

    Attributes:
        motion: samples of the motion.
        frames: joint frames at the samples, (n, nj, 4, 4), m.
        tip: tip positions at the samples, (n, 3), m.
        parts: the robot's links and joints.
        spheres: the robot's collision spheres.
        targets: positions of tip goals, (k, 3), m.
        goals: joint goals, each (nv,).
        space: the box that is drawn.
        shapes: the obstacles.
        solids: meshes of what the box shows of them, finely tiled.
        missing: names of obstacles that cannot be drawn.
        distance: sampled clearance to the obstacles, (n,), m, or None.
        closest: where the motion comes nearest to one of ``shapes``, or None.
        traces: tool traces of the trees, "start" and "goal", each (k, 2, 3), m.
        view: direction to look from.
    """

    motion: Motion
    frames: Array
    tip: Array
    parts: list[Part]
    spheres: list[Part]
    targets: Array
    goals: list[Array]
    space: Workspace
    shapes: list[Obstacle]
    solids: list[Mesh]
    missing: list[str]
    distance: Array | None
    closest: Approach | None
    traces: dict[str, Array]
    view: View


def drawing_of(document: dict[str, Any]) -> Drawing:
    """What there is to draw of a plan result.

    Raises:
        DocumentError: the document has no robot or problem, or they are not
            of the form of a plan result.
    """
    require_plan(document)
    try:
        return _drawing(document)
    except (LookupError, TypeError, ValueError, AttributeError, OverflowError) as error:
        message = f"not of the form of a plan result: {error!r}"[:300]
        raise DocumentError("plan", message) from error


def _drawing(document: dict[str, Any]) -> Drawing:
    robot = document["robot"]
    motion = motion_of(document)
    frames = joint_frames(robot, motion.q)
    tip = tip_positions(robot, frames)
    targets, goals = _goals(document)
    traces = tool_traces(document)
    extent = _extent(robot, frames, [tip, targets, *traces.values()])
    space = workspace(extent, border=0.12)
    shapes, missing = obstacles_of(document)
    tile = space.size / TILES
    solids, outside = _solids(shapes, space, tile)
    watched = _watched(frames, tip, targets)
    near = sampled_clearance(robot, shapes, motion.q) if motion.moves else None
    return Drawing(
        motion=motion,
        frames=frames,
        tip=tip,
        parts=parts_of(robot),
        spheres=spheres_of(robot),
        targets=targets,
        goals=goals,
        space=space,
        shapes=shapes,
        solids=solids,
        missing=missing + outside,
        distance=None if near is None else near.distance,
        closest=None if near is None else near.closest,
        traces=traces,
        view=best_view(watched, merged(solids).corners, cell=tile),
    )


def _solids(
    shapes: list[Obstacle], space: Workspace, tile: float
) -> tuple[list[Mesh], list[str]]:
    """Shapes as they are drawn, and the names of those outside the workspace."""
    solids = [drawn(shape, space, tile=tile) for shape in shapes]
    outside = [
        f"{shape.name} (outside)"
        for shape, solid in zip(shapes, solids, strict=True)
        if not len(solid.quads)
    ]
    return [solid for solid in solids if len(solid.quads)], outside


def _goals(document: dict[str, Any]) -> tuple[Array, list[Array]]:
    """Positions of tip goals, (k, 3), and joint goals."""
    goals = document["problem"].get("goal") or []
    goals = goals if isinstance(goals, list) else [goals]
    positions = [g["position"] for g in goals if g.get("position") is not None]
    joints = [np.asarray(g["joints"], dtype=float) for g in goals if g.get("joints")]
    return np.asarray(positions, dtype=float).reshape(-1, 3), joints


def _extent(robot: dict[str, Any], frames: Array, seen: list[Array]) -> Array:
    """Points that have to be inside the picture, (n, 3), m."""
    centres, radii = sphere_centres(robot, frames)
    around = [centres + sign * radii[:, None] for sign in (-1.0, 1.0)]
    origins = frames[:, :, :3, 3]
    points = [np.zeros((1, 3)), *seen, origins, *around]
    return np.concatenate([p.reshape(-1, 3) for p in points])


def _watched(frames: Array, tip: Array, targets: Array) -> Array:
    """Points that should not be hidden: tip path, last posture, targets."""
    path = tip[:: max(1, len(tip) // 20)]
    last = frames[-1, :, :3, 3]
    start = frames[0, :, :3, 3]
    return np.concatenate([path, path, last, start, tip[-1:], targets])
