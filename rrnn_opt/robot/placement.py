"""Constant poses: homogeneous matrices whose quarter turns are exact."""

from __future__ import annotations

import math

import numpy as np

from rrnn_opt.robot.tree import Array

_QUARTER = {0: (1.0, 0.0), 1: (0.0, 1.0), 2: (-1.0, 0.0), 3: (0.0, -1.0)}


def _cos_sin(degrees: float) -> tuple[float, float]:
    turns, rest = divmod(degrees, 90.0)
    if rest == 0.0:
        return _QUARTER[int(turns) % 4]
    return math.cos(math.radians(degrees)), math.sin(math.radians(degrees))


def turn(axis: str, degrees: float) -> Array:
    """Rotation about a coordinate axis; entries of quarter turns are 0 and +-1.

    Args:
        axis: "x", "y" or "z".
        degrees: angle, degrees.

    Returns:
        Homogeneous matrix, (4, 4).
    """
    c, s = _cos_sin(degrees)
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    pose = np.eye(4)
    pose[i, i] = pose[j, j] = c
    pose[i, j], pose[j, i] = -s, s
    return pose + 0.0  # no negative zeros


def shift(x: float, y: float, z: float) -> Array:
    """Translation by (x, y, z), m; homogeneous matrix, (4, 4)."""
    pose = np.eye(4)
    pose[:3, 3] = x, y, z
    return pose


def compose(*poses: Array) -> Array:
    """Product of homogeneous matrices, without negative zeros, (4, 4)."""
    product = np.eye(4)
    for pose in poses:
        product = product @ pose
    return product + 0.0


def apply(pose: Array, point: Array) -> Array:
    """The point in the parent's axes, (3,), m."""
    moved: Array = pose[:3, :3] @ point + pose[:3, 3]
    return moved
