"""The 3D scene of a page: viser's own offline viewer with a recording in it."""

from __future__ import annotations

import contextlib
import io
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.report.plan.drawing import Drawing
from rrnn_opt.report.plan.mesh import Mesh, merged
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
    rgb,
    time_colours,
)
from rrnn_opt.report.plan.stage import drawn
from rrnn_opt.scene.pose import quaternion_from_matrix

Array = NDArray[np.float64]

INSTALL = "pip install rrnn_opt[viz]"
LENS = 1.75
LAST_FRAME = 0.5


def scene_html(drawing: Drawing) -> str | None:
    """The scene as a self-contained HTML document.

    Args:
        drawing: what there is to draw.

    Returns:
        The document; None where viser is not installed.
    """
    try:
        import viser
    except ImportError:
        return None
    with _server(viser) as server:
        server.scene.set_up_direction("+z")
        _camera(server, drawing)
        _surroundings(server.scene, drawing)
        _search(server.scene, drawing)
        handles = _robot(server.scene, drawing)
        if drawing.motion.moves:
            placed = [part.placed(drawing.frames[-1]).mesh for part in drawing.parts]
            _add(server.scene, "/end", merged(placed[1:]), END, opacity=0.18)
        recorder = server.get_scene_serializer()
        pauses = [*np.diff(drawing.motion.t), LAST_FRAME]
        for k, pause in enumerate(pauses):
            for joint, handle in handles.items():
                _place(handle, drawing.frames[k, joint])
            recorder.insert_sleep(float(pause))
        html: str = recorder.as_html()
    return html


@contextlib.contextmanager
def _server(viser: Any) -> Iterator[Any]:
    """A server that only this process can reach, and that says nothing."""
    with contextlib.redirect_stdout(io.StringIO()):
        server = viser.ViserServer(host="127.0.0.1", port=_free_port(), verbose=False)
    try:
        yield server
    finally:
        with contextlib.redirect_stdout(io.StringIO()):
            server.stop()


def _free_port() -> int:
    import socket

    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
    return port


def _camera(server: Any, drawing: Drawing) -> None:
    space = drawing.space
    eye = space.centre + LENS * space.size * drawing.view.towards_viewer
    server.initial_camera.position = tuple(map(float, eye))
    server.initial_camera.look_at = tuple(map(float, space.centre))
    server.initial_camera.fov = 0.75


def _surroundings(scene: Any, drawing: Drawing) -> None:
    space = drawing.space
    scene.add_grid(
        "/floor",
        width=1.6 * space.size,
        height=1.6 * space.size,
        cell_size=space.size / 10,
        section_size=space.size,
        cell_color=rgb(GRID),
        section_color=rgb(START),
        position=(space.centre[0], space.centre[1], space.low[2]),
    )
    for k, shape in enumerate(drawing.shapes):
        solid = drawn(shape, space, tile=np.inf)
        side = "double" if shape.kind == "halfspace" else "front"
        near = drawing.closest is not None and drawing.closest.obstacle == k
        colour = NEAREST if near else OBSTACLE
        _add(scene, f"/obstacles/{k}", solid, colour, opacity=0.5, side=side)
    for k, target in enumerate(drawing.targets):
        scene.add_icosphere(
            f"/target/{k}",
            radius=0.014 * space.size,
            color=rgb(TARGET),
            position=tuple(map(float, target)),
        )
    if drawing.motion.moves:
        pieces = np.stack([drawing.tip[:-1], drawing.tip[1:]], axis=1)
        shades = (255 * time_colours(len(pieces))[:, :3]).astype(np.uint8)
        colours = np.repeat(shades[:, None], 2, axis=1)
        thick = 0.008 * space.size
        scene.add_line_segments("/tip path", pieces, colours, thickness=thick)


def _search(scene: Any, drawing: Drawing) -> None:
    """Tool traces of both trees, and the closest approach to an obstacle."""
    size = drawing.space.size
    for side, pieces in drawing.traces.items():
        if len(pieces):
            colours = np.broadcast_to(
                np.array(rgb(TREES[side]), np.uint8), pieces.shape
            )
            name = f"/trees/{side}"
            scene.add_line_segments(name, pieces, colours, thickness=0.003 * size)
    if drawing.closest is not None:
        ends = drawing.closest.ends
        colours = np.broadcast_to(np.array(rgb(NEAREST), np.uint8), (1, 2, 3))
        scene.add_line_segments(
            "/closest/line", ends[None], colours, thickness=0.006 * size
        )
        for k, end in enumerate(ends):
            place = tuple(map(float, end))
            scene.add_icosphere(
                f"/closest/{k}", radius=0.008 * size, color=rgb(NEAREST), position=place
            )


def _robot(scene: Any, drawing: Drawing) -> dict[int, Any]:
    """Frames of the joints by index, the robot's parts fixed to them."""
    handles: dict[int, Any] = {}
    dark = tuple(int(0.7 * c) for c in rgb(END))
    looks = {"link": rgb(END), "tip": rgb(END), "joint": dark, "base": rgb(PLATE)}
    for joint in range(-1, drawing.frames.shape[1]):
        name = "/robot" if joint < 0 else f"/robot/{joint}"
        if joint >= 0:
            handles[joint] = scene.add_frame(name, show_axes=False)
        for role, colour in looks.items():
            pieces = [
                p.mesh for p in drawing.parts if (p.joint, p.role) == (joint, role)
            ]
            if pieces:
                _add(scene, f"{name}/{role}", merged(pieces), colour)
        shells = [p.mesh for p in drawing.spheres if p.joint == joint]
        if shells:
            _add(scene, f"{name}/spheres", merged(shells), SHELL, opacity=0.10)
    return handles


def _add(
    scene: Any,
    name: str,
    solid: Mesh,
    colour: Any,
    *,
    opacity: float | None = None,
    side: str = "front",
) -> None:
    if not len(solid.quads):
        return
    scene.add_mesh_simple(
        name,
        solid.vertices.astype(np.float32),
        solid.triangles.astype(np.uint32),
        color=rgb(colour) if isinstance(colour, str) else colour,
        opacity=opacity,
        side=side,
        cast_shadow=opacity is None,
        receive_shadow=opacity is None,
    )


def _place(handle: Any, pose: Array) -> None:
    x, y, z, w = quaternion_from_matrix(pose[:3, :3])
    handle.wxyz = (w, x, y, z)
    handle.position = tuple(map(float, pose[:3, 3]))
