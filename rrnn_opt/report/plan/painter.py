"""Painter's algorithm: faces of all solids sorted together, lit by one lamp."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rrnn_opt.report.plan.camera import View
from rrnn_opt.report.plan.mesh import Mesh

Array = NDArray[np.float64]

AMBIENT = 0.5
BRIGHT = 1.1
LENS = 3.4


class Painter:
    """Collects faces, then paints them far to near into plain 2D axes.

    Args:
        view: direction to look from.
        centre: point looked at, (3,), m.
        size: edge of the scene, m; the viewer stands ``LENS`` of it away.
    """

    def __init__(self, view: View, centre: ArrayLike, size: float) -> None:
        self._view = view
        self._centre = np.asarray(centre, dtype=float)
        self._distance = LENS * size
        self._faces: list[Array] = []
        self._colours: list[Array] = []
        self._lines: list[Array] = []

    def project(self, points: Array) -> Array:
        """Picture coordinates and depth towards the viewer, (..., 3), m."""
        seen = (points - self._centre) @ self._view.axes.T
        scale = self._distance / (self._distance - seen[..., 2:])
        return np.concatenate([seen[..., :2] * scale, seen[..., 2:]], axis=-1)

    def add(
        self, solid: Mesh, colour: Any, *, alpha: float = 1.0, lit: bool = True
    ) -> None:
        """Add a solid.

        Args:
            solid: in world axes.
            colour: any matplotlib colour.
            alpha: opacity.
            lit: with light and shadow.
        """
        from matplotlib.colors import to_rgba

        corners = solid.corners
        if not len(corners) or alpha <= 0.0:
            return
        rgba = np.tile(to_rgba(colour, alpha), (len(corners), 1))
        if lit:
            rgba[:, :3] = np.clip(rgba[:, :3] * self._light(corners), 0.0, 1.0)
        self._faces.append(self.project(corners))
        self._colours.append(rgba)

    def ribbons(self, pieces: Array, width: float, colour: Any, alpha: float) -> None:
        """Add straight lines (k, 2, 3) as flat ribbons that face the viewer.

        Args:
            pieces: ends of each line, m.
            width: m.
            colour: any matplotlib colour.
            alpha: opacity.
        """
        from matplotlib.colors import to_rgba

        shown = self.project(pieces)
        along = shown[:, 1, :2] - shown[:, 0, :2]
        length = np.maximum(np.linalg.norm(along, axis=1), 1e-12)[:, None]
        across = np.zeros((len(pieces), 3))
        across[:, :2] = 0.5 * width * along[:, ::-1] * (-1.0, 1.0) / length
        a, b = shown[:, 0], shown[:, 1]
        sides = (a - across, b - across, b + across, a + across)
        self._faces.append(np.stack(sides, axis=1))
        self._colours.append(np.tile(to_rgba(colour, alpha), (len(pieces), 1)))

    def lines(self, grid: Array) -> None:
        """Add the lines of a grid of points, (m, n, 3), behind everything."""
        shown = self.project(grid)[..., :2]
        self._lines += [*shown, *np.swapaxes(shown, 0, 1)]

    def paint(self, axes: Any, *, line_colour: str) -> None:
        """Paint what was added into 2D axes, filling them."""
        from matplotlib.collections import LineCollection, PolyCollection

        faces, colours = np.concatenate(self._faces), np.concatenate(self._colours)
        order = np.argsort(faces[..., 2].mean(axis=1), kind="stable")
        axes.set_axis_off()
        if self._lines:
            axes.add_collection(
                LineCollection(
                    self._lines, colors=line_colour, linewidths=0.7, zorder=0
                )
            )
        axes.add_collection(
            PolyCollection(
                list(faces[order, :, :2]),
                facecolors=colours[order],
                edgecolors="none",
                antialiaseds=False,
            )
        )
        flat = np.concatenate([faces[..., :2].reshape(-1, 2), *self._lines])
        _fill(axes, flat.min(axis=0), flat.max(axis=0))

    def _light(self, corners: Array) -> Array:
        """Brightness of faces, (f, 1): a lamp over the viewer's left shoulder."""
        lamp = np.array([-0.35, 0.55, 0.75]) @ self._view.axes
        normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
        length = np.linalg.norm(normal, axis=1)
        cosine = np.abs(normal @ lamp) / np.where(length > 0.0, length, 1.0)
        brightness: Array = AMBIENT + (BRIGHT - AMBIENT) * cosine[:, None]
        return brightness


def _fill(axes: Any, low: Array, high: Array) -> None:
    """Show the rectangle as large as it gets, with equal scales."""
    box = axes.get_window_extent()
    scale = float(max((high - low) / (box.width, box.height)))
    middle, half = (low + high) / 2, 0.5 * scale * np.array([box.width, box.height])
    axes.set_xlim(middle[0] - half[0], middle[0] + half[0])
    axes.set_ylim(middle[1] - half[1], middle[1] + half[1])
