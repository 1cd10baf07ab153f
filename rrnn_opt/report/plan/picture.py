"""The picture of a plan: the scene on the left, small charts on the right."""

from __future__ import annotations

import io
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.report.axes import INK
from rrnn_opt.report.files import write_bytes
from rrnn_opt.report.plan import charts, mesh
from rrnn_opt.report.plan.camera import View
from rrnn_opt.report.plan.drawing import TILES, Drawing, drawing_of
from rrnn_opt.report.plan.key import draw_key, nearest_approach
from rrnn_opt.report.plan.painter import Painter
from rrnn_opt.report.plan.palette import (
    END,
    GRID,
    NEAREST,
    OBSTACLE,
    PLATE,
    SHELL,
    START,
    TARGET,
    TREES,
    time_colours,
)
from rrnn_opt.report.plan.stage import drawn
from rrnn_opt.report.save import drawable, save

Array = NDArray[np.float64]

DPI = 110
OVERSAMPLING = 2
GHOSTS = 5
APART = 0.01


def draw_plan(document: dict[str, Any], path: str | Path) -> None:
    """Write the PNG of a plan result.

    Args:
        document: plan result.
        path: file to write; it appears whole or not at all.

    Raises:
        DocumentError: the document is not a plan result.
        OSError: the file cannot be written.
    """
    write_bytes(path, picture(document))


def picture(document: dict[str, Any], drawing: Drawing | None = None) -> bytes:
    """The PNG of a plan result.

    Args:
        document: plan result.
        drawing: of that document, where the caller has it already.

    Raises:
        DocumentError: the document is not a plan result.
    """
    from matplotlib.figure import Figure
    from PIL import Image

    drawing = drawing_of(document) if drawing is None else drawing
    panels = chart_list(document, drawing)
    figure = Figure(figsize=(12.4, 6.6), dpi=DPI * OVERSAMPLING, facecolor="white")
    width = 0.62 if panels else 0.98
    scene = figure.add_axes((0.01, 0.06, width, 0.87))
    _scene(scene, drawing)
    _title(figure, document, drawing)
    for place, panel in zip(_places(len(panels)), panels, strict=True):
        panel(figure.add_axes(place))
    raw = io.BytesIO()
    save(figure, raw, format="png")
    image = Image.open(raw).convert("RGB").reduce(OVERSAMPLING)
    small = io.BytesIO()
    image.save(small, format="png", optimize=False)
    return small.getvalue()


def chart_list(document: dict[str, Any], drawing: Drawing) -> list[Any]:
    """The charts that this document has data for, as functions of their axes."""
    motion, distance = drawing.motion, drawing.distance
    found: list[Any] = []
    if motion.qd is not None and motion.moves:
        found.append(lambda axes: charts.velocities(axes, document, motion))
    cell = np.asarray((document.get("stats") or {}).get("memory_cell") or [], float)
    if cell.size:
        found.append(lambda axes: charts.memory_cell(axes, cell))
    if distance is not None and motion.qd is not None:
        closest = nearest_approach(drawing)
        proved = (document.get("certificate") or {}).get("clearance_lower_bound")
        found.append(
            lambda axes: charts.clearance(axes, motion, distance, proved, closest)
        )
    return found


def draw_scene(
    axes: Any,
    document: dict[str, Any],
    *,
    view: View | None = None,
    focus: tuple[Array, float] | None = None,
) -> None:
    """Draw only the scene of a plan result, for figures of several.

    Args:
        axes: of matplotlib.
        document: plan result; without a trajectory its path is drawn.
        view: direction to look from, by default one that hides little.
        focus: point (3,) in the middle and width that is shown, m; by default
            everything.

    Raises:
        DocumentError: the document is not a plan result.
    """
    drawing = drawing_of(document)
    drawing = drawing if view is None else replace(drawing, view=view)
    _scene(axes, drawing)
    if focus is not None:
        space = drawing.space
        centre, width = np.asarray(focus[0], dtype=float), focus[1]
        x, y, _ = Painter(drawing.view, space.centre, space.size).project(centre)
        box = axes.get_window_extent()
        half = 0.5 * width
        axes.set_xlim(x - half, x + half)
        axes.set_ylim(
            y - half * box.height / box.width, y + half * box.height / box.width
        )


def _scene(axes: Any, drawing: Drawing) -> None:
    space = drawing.space
    painter = Painter(drawing.view, space.centre, space.size)
    grid = mesh.plate(space.low, space.high, (0, 1), space.size / 12)
    grid[..., 2] = space.low[2]
    painter.lines(grid)
    for solid in drawing.solids:
        painter.add(solid, OBSTACLE, alpha=0.36)
    for side, traces in drawing.traces.items():
        painter.ribbons(traces, 0.003 * space.size, TREES[side], 0.75)
    _nearest(painter, drawing)
    _postures(painter, drawing)
    colours = time_colours(len(drawing.tip))
    pieces = zip(drawing.tip[:-1], drawing.tip[1:], colours, strict=False)
    for a, b, colour in pieces:
        painter.add(mesh.tube(a, b, 0.006 * space.size), colour, lit=False)
    for part in drawing.spheres:
        painter.add(part.placed(drawing.frames[0]).mesh, SHELL, alpha=0.07)
    for target in drawing.targets:
        painter.add(mesh.sphere(target, 0.014 * space.size, sides=14), TARGET)
    painter.paint(axes, line_colour=GRID)
    for x, y, _ in painter.project(drawing.targets):
        axes.plot(x, y, "o", ms=15, mfc="none", mec=TARGET, mew=1.6)
        axes.plot(x, y, "+", ms=9, color=TARGET, mew=1.6)
    if drawing.closest is not None:
        x, y, _ = painter.project(drawing.closest.ends).mean(axis=0)
        axes.plot(x, y, "o", ms=17, mfc="none", mec=NEAREST, mew=1.8)


def _nearest(painter: Painter, drawing: Drawing) -> None:
    """The obstacle that the motion comes nearest to, its faces tinted."""
    if drawing.closest is None:
        return
    space = drawing.space
    shape = drawing.shapes[drawing.closest.obstacle]
    solid = drawn(shape, space, tile=space.size / TILES)
    painter.add(solid, NEAREST, alpha=0.16)
    painter.ribbons(drawing.closest.ends[None], 0.008 * space.size, NEAREST, 1.0)


def _postures(painter: Painter, drawing: Drawing) -> None:
    """End and start, then ghosts; nothing twice in the same place."""
    count = len(drawing.tip)
    colours = time_colours(count)
    postures = [(count - 1, END, 1.0), (0, START, 0.95)]
    if not drawing.motion.moves:
        postures = postures[1:]
    else:
        between = np.linspace(0, count - 1, GHOSTS + 2).round().astype(int)[1:-1]
        postures += [(int(k), colours[k], 0.10) for k in between]
    seen: list[list[Array]] = [[] for _ in drawing.parts]
    for k, colour, alpha in postures:
        for part, before in zip(drawing.parts, seen, strict=True):
            placed = part.placed(drawing.frames[k])
            moved = [np.abs(placed.ends - ends).max() for ends in before]
            if min(moved, default=np.inf) > APART * drawing.space.size:
                before.append(placed.ends)
                painter.add(placed.mesh, _tint(part.role, colour), alpha=alpha)


def _tint(role: str, colour: Any) -> Any:
    """Colour of a part: the posture's, darker at joints, grey for the base."""
    from matplotlib.colors import to_rgb

    dark = tuple(0.7 * c for c in to_rgb(colour))
    return {"base": PLATE, "joint": dark}.get(role, colour)


def _title(figure: Any, document: dict[str, Any], drawing: Drawing) -> None:
    name = drawable(document["robot"].get("name", "robot"))
    proof = document.get("certificate") or {}
    said = [drawable(document.get(key, "")) for key in ("status", "planner")]
    for key in ("collision_free", "limits"):
        if proof.get(key):
            said.append(f"{key.replace('_', ' ')}: {drawable(proof[key])}")
    figure.text(
        0.02, 0.955, name, fontsize=15, weight="bold", color=INK, parse_math=False
    )
    figure.text(
        0.02 + 0.0105 * (len(name) + 1),
        0.957,
        "   ".join(s for s in said if s),
        fontsize=10,
        color="#5b6270",
        parse_math=False,
    )
    draw_key(figure, drawing)


def _places(count: int) -> list[tuple[float, float, float, float]]:
    """Axes of the charts, from the top, in figure coordinates."""
    if not count:
        return []
    bottom, top, gap = 0.075, 0.94, 0.115
    height = (top - bottom - gap * (count - 1)) / count
    height = min(height, 0.34)
    return [
        (0.68, top - height - k * (height + gap), 0.30, height) for k in range(count)
    ]
