"""Where to look from: the view that hides least of the motion."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

ELEVATIONS = (14.0, 22.0, 32.0, 50.0, 75.0)
AZIMUTHS = tuple(range(-180, 180, 10))
USUAL = (22.0, -60.0)
ENOUGH = 0.5


@dataclass(frozen=True)
class View:
    """A direction of view, as matplotlib counts it.

    Attributes:
        elevation: above the horizon, degrees.
        azimuth: around z, degrees.
    """

    elevation: float
    azimuth: float

    @property
    def towards_viewer(self) -> Array:
        """Unit vector from the scene to the viewer, (3,)."""
        e, a = np.radians([self.elevation, self.azimuth])
        return np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])

    @property
    def axes(self) -> Array:
        """Rows: right, up and towards the viewer, (3, 3)."""
        back = self.towards_viewer
        right = np.cross([0.0, 0.0, 1.0], back)
        right /= np.linalg.norm(right)
        return np.stack([right, np.cross(back, right), back])


def best_view(points: Array, faces: Array, *, cell: float) -> View:
    """The view with the best score over a grid of directions.

    The score adds the share of ``points`` with nothing in front, how widely
    they spread over the picture, how far the obstacles turn their faces to
    the viewer, and a small bonus near the usual view.

    Args:
        points: what should be seen, (n, 3), m.
        faces: corners of the obstacles' drawn faces, (f, 4, 3), m.
        cell: size of these faces, m.
    """
    views = [View(e, float(a)) for e in ELEVATIONS for a in AZIMUTHS]
    normals = np.cross(faces[:, 2] - faces[:, 0], faces[:, 3] - faces[:, 1])
    centres = faces.mean(axis=1)

    def score(view: View) -> float:
        free = unhidden(view, points, centres, cell)
        facing = _facing(view, normals)
        return free + 1.6 * _spread(view, points) + 0.7 * facing - _unusual(view)

    return max(views, key=score)


def unhidden(view: View, points: Array, centres: Array, cell: float) -> float:
    """Share of points with no face between them and the viewer."""
    seen, hiding = points @ view.axes.T, centres @ view.axes.T
    apart = np.abs(seen[:, None, :2] - hiding[None, :, :2]).max(axis=2)
    nearer = hiding[None, :, 2] > seen[:, None, 2] + 0.5 * cell
    return 1.0 - float(np.mean(np.any((apart < 0.6 * cell) & nearer, axis=1)))


def _spread(view: View, points: Array) -> float:
    """Sum of the two standard deviations in the picture over the extent."""
    flat = (points - points.mean(axis=0)) @ view.axes[:2].T
    deviations = np.sqrt(np.linalg.eigvalsh(flat.T @ flat / len(flat)).clip(0.0))
    return float(deviations.sum()) / (float(np.ptp(points, axis=0).max()) or 1.0)


def _facing(view: View, normals: Array) -> float:
    """Share of the faces' area that is seen, up to ``ENOUGH``."""
    area = float(np.linalg.norm(normals, axis=1).sum())
    seen = float(np.abs(normals @ view.towards_viewer).sum())
    return min(seen / area, ENOUGH) if area > 0.0 else 0.0


def _unusual(view: View) -> float:
    turn = abs((view.azimuth - USUAL[1] + 180.0) % 360.0 - 180.0) / 180.0
    return 0.1 * turn + 0.002 * abs(view.elevation - USUAL[0])
