"""Balls about points."""

from __future__ import annotations

import numpy as np

from rrnn_opt.robot.tree import Array

STEPS = 64
DIRECTIONS = 96


def smallest_ball(points: Array) -> tuple[Array, float]:
    """A ball that holds all points (n, 3), little larger than the smallest.

    Badoiu and Clarkson (SODA 2003): step k goes 1/(k + 1) of the way to the
    farthest point; the radius is the largest distance at the end.
    """
    points = np.unique(points, axis=0)
    center = 0.5 * (points.min(axis=0) + points.max(axis=0))
    best, least = center, np.inf
    for k in range(STEPS):
        away = np.linalg.norm(points - center, axis=1)
        far = int(np.argmax(away))
        if away[far] < least:
            best, least = center, float(away[far])
        center = center + (points[far] - center) / (k + 2)
    return best, least


def directions() -> Array:
    """Unit vectors spread evenly over the sphere, (n, 3)."""
    k = np.arange(DIRECTIONS) + 0.5
    z = 1 - 2 * k / DIRECTIONS
    turn = np.pi * (1 + 5**0.5) * k
    flat = np.sqrt(1 - z * z)
    return np.stack([flat * np.cos(turn), flat * np.sin(turn), z], axis=1)


def outermost(points: Array) -> Array:
    """Those farthest in one of many directions: enough to place a ball by."""
    if len(points) <= DIRECTIONS:
        return points
    far = np.unique(np.argmax(points @ directions().T, axis=0))
    return np.asarray(points[far])
