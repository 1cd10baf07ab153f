"""Collision spheres that contain a capsule, a cylinder or a box.

Each cover comes with its inflation: no point of a sphere lies farther than
that outside the shape.  It is what the planner may lose by seeing spheres.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import ArrayLike

from rrnn_opt.robot.tree import Array

_ROUNDING = 1e-12  # m, added to every radius: far above the rounding of a sum


@dataclass(frozen=True, eq=False)
class Cover:
    """Spheres of one radius whose union contains a shape.

    Attributes:
        centers: (n, 3), m.
        radius: m.
        inflation: largest distance of a sphere's point to the shape, m.
    """

    centers: Array
    radius: float
    inflation: float


def cover_capsule(
    a: ArrayLike, b: ArrayLike, *, radius: float, inflation: float = 2e-3
) -> Cover:
    """The fewest equal spheres on the axis that contain a capsule.

    With m gaps between centres, the outermost inset by d from the ends and
    radius r + d: the caps need no more than the inset, and the side between
    two centres needs (r + d)^2 >= r^2 + ((L - 2 d) / (2 m))^2, which is

        (4 m^2 - 4) d^2 + (8 r m^2 + 4 L) d - L^2 = 0   at equality.

    Args:
        a: first end of the axis, (3,), m.
        b: other end, (3,), m.
        radius: of the capsule, m.
        inflation: largest d that is accepted, m.

    Returns:
        The cover; its inflation is d.
    """
    first, last = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    length = float(np.linalg.norm(last - first))
    if length == 0.0:
        return Cover(first[None, :], radius + _ROUNDING, _ROUNDING)
    gaps = 1
    while (inset := _inset(length, radius, gaps)) > inflation:
        gaps += 1
    share = np.linspace(inset / length, 1.0 - inset / length, gaps + 1)
    centers = first + share[:, None] * (last - first)
    return Cover(centers, radius + inset + _ROUNDING, inset + _ROUNDING)


def _inset(length: float, radius: float, gaps: int) -> float:
    """Positive root of the equation in ``cover_capsule``."""
    square = 4.0 * gaps * gaps - 4.0
    linear = 8.0 * radius * gaps * gaps + 4.0 * length
    root = math.sqrt(linear * linear + 4.0 * square * length * length)
    return 2.0 * length * length / (linear + root)


def cover_cylinder(
    radius: float, length: float, *, inflation: float = 0.01, most: int = 64
) -> Cover:
    """Spheres on the axis (local z) that contain a cylinder.

    The cylinder is cut into n equal slices; the sphere about a slice has
    radius sqrt(r^2 + (l / 2n)^2).  Slices are added until the sides bulge by
    no more than ``inflation``; the flat ends bulge by nearly the radius.

    Args:
        radius: of the cylinder, m.
        length: m.
        inflation: largest bulge of the sides that is accepted, m.
        most: largest number of spheres.

    Returns:
        The cover in the cylinder's own frame; its inflation counts the ends.
    """
    count = 1
    while math.hypot(radius, length / (2 * count)) - radius > inflation:
        if count == most:
            break
        count += 1
    half = length / (2 * count)
    outer = math.hypot(radius, half) + _ROUNDING
    centers = np.zeros((count, 3))
    centers[:, 2] = (2 * np.arange(count) + 1) * half - length / 2
    return Cover(centers, outer, outer - min(radius, half))


def cover_box(size: ArrayLike, *, inflation: float = 0.01, most: int = 64) -> Cover:
    """Spheres about the cells of a grid that contain a box.

    The longest cell edge is halved in turn; a cell of half edges e has the
    sphere of radius |e| about its centre, which holds a ball of radius
    min(e) inside the box, hence an inflation of at most |e| - min(e).

    Args:
        size: full edges, (3,), m.
        inflation: wanted inflation, m; missed when ``most`` is too small.
        most: largest number of spheres.

    Returns:
        The cover in the box's own frame (origin at its centre).
    """
    edges = np.asarray(size, dtype=float)
    cells = np.ones(3, dtype=int)
    while _bulge(edges / cells) > inflation:
        finer = cells.copy()
        finer[int(np.argmax(edges / cells))] += 1
        if int(np.prod(finer)) > most:
            break
        cells = finer
    marks = [
        ((2 * np.arange(n) + 1) / (2 * n) - 0.5) * edge
        for n, edge in zip(cells, edges, strict=True)
    ]
    centers = np.array(list(product(*marks)))
    outer = float(np.linalg.norm(edges / cells)) / 2 + _ROUNDING
    return Cover(centers, outer, _bulge(edges / cells) + _ROUNDING)


def _bulge(cell: Array) -> float:
    return float(np.linalg.norm(cell) - np.min(cell)) / 2
