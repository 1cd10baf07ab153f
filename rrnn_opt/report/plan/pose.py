"""Numeric poses of a robot block, for drawing only.

The reports read documents, not models: everything here works on the ``robot``
block of a plan result and on plain arrays, so that an old result can be drawn
without the robot that made it.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def rotation_about(axis: Array, angle: Array) -> Array:
    """Rotation matrices by Rodrigues' formula ``R = I + s K + (1 - c) K K``.

    Args:
        axis: unit axis, (3,).
        angle: rad, (n,).

    Returns:
        Matrices, (n, 3, 3).
    """
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    sine, versine = np.sin(angle), 1.0 - np.cos(angle)
    result: Array = (
        np.eye(3)
        + sine[:, None, None] * cross
        + versine[:, None, None] * (cross @ cross)
    )
    return result


def joint_frames(robot: dict[str, Any], q: ArrayLike) -> Array:
    """World poses of all joint frames.

    Args:
        robot: robot block of a plan result.
        q: joint values, (n, nv), rad or m.

    Returns:
        Poses, (n, nj, 4, 4), m.
    """
    values = np.atleast_2d(np.asarray(q, dtype=float))
    coupling = robot["coupling"]
    frames = np.zeros((len(values), len(robot["parents"]), 4, 4))
    for k, parent in enumerate(robot["parents"]):
        axis = np.asarray(robot["axes"][k], dtype=float)
        value = coupling["multiplier"][k] * values[:, coupling["source"][k]]
        value = value + coupling["offset"][k]
        motion = np.tile(np.eye(4), (len(values), 1, 1))
        if robot["types"][k] == "prismatic":
            motion[:, :3, 3] = value[:, None] * axis
        else:
            motion[:, :3, :3] = rotation_about(axis, value)
        fixed = np.asarray(robot["placements"][k], dtype=float)
        carried = fixed @ motion
        frames[:, k] = carried if parent < 0 else frames[:, parent] @ carried
    return frames


def frame_of(frames: Array, joint: int) -> Array:
    """Poses of one joint's frame, (n, 4, 4); the world's for the base (-1)."""
    if joint < 0:
        return np.tile(np.eye(4), (len(frames), 1, 1))
    picked: Array = frames[:, joint]
    return picked


def tip_positions(robot: dict[str, Any], frames: Array) -> Array:
    """Positions of the tip, (n, 3), m."""
    tip = robot["tip"]
    placement = np.asarray(tip["placement"], dtype=float)
    poses: Array = frame_of(frames, tip["joint"]) @ placement
    return poses[:, :3, 3]


def sphere_centres(robot: dict[str, Any], frames: Array) -> tuple[Array, Array]:
    """Centres (n, ns, 3) and radii (ns,) of the collision spheres, m."""
    spheres = robot.get("spheres", [])
    centres = np.zeros((len(frames), len(spheres), 3))
    for i, sphere in enumerate(spheres):
        pose = frame_of(frames, sphere["joint"])
        centres[:, i] = pose[:, :3, :3] @ np.asarray(sphere["center"], dtype=float)
        centres[:, i] += pose[:, :3, 3]
    return centres, np.array([s["radius"] for s in spheres], dtype=float)
