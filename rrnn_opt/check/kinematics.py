"""Forward kinematics of many configurations at once, from plain arrays."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rrnn_opt.check.model import Model
from rrnn_opt.check.reading import Array


class Frames(NamedTuple):
    """Joint frames in the world at N configurations.

    Attributes:
        rotations: (N, nj, 3, 3).
        origins: (N, nj, 3), m.
        axes: joint axes, (N, nj, 3).
    """

    rotations: Array
    origins: Array
    axes: Array


def turn(axis: Array, angle: Array) -> Array:
    """Rotations about one unit axis: cos I + sin [a]x + (1 - cos) a a'.

    Args:
        axis: (3,).
        angle: (N,), rad.

    Returns:
        (N, 3, 3).
    """
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    c, s = np.cos(angle)[:, None, None], np.sin(angle)[:, None, None]
    result: Array = c * np.eye(3) + s * cross + (1 - c) * np.outer(axis, axis)
    return result


def forward(model: Model, joints: Array) -> Frames:
    """Frames of all joints.

    Args:
        model: the robot.
        joints: joint values (not coordinates), (N, nj), rad or m.
    """
    n = len(joints)
    rotations = np.empty((n, model.nj, 3, 3))
    origins = np.empty((n, model.nj, 3))
    axes = np.empty((n, model.nj, 3))
    for k, parent in enumerate(model.parents):
        if parent < 0:
            base_r, base_p = np.eye(3), np.zeros(3)
        else:
            base_r, base_p = rotations[:, parent], origins[:, parent]
        placed = base_r @ model.rotation[k]
        axes[:, k] = placed @ model.axes[k]
        origins[:, k] = base_p + base_r @ model.translation[k]
        if model.prismatic[k]:
            rotations[:, k] = placed
            origins[:, k] += joints[:, k, None] * axes[:, k]
        else:
            rotations[:, k] = placed @ turn(model.axes[k], joints[:, k])
    return Frames(rotations, origins, axes)


def sphere_centres(model: Model, frames: Frames) -> Array:
    """Centres of all spheres in the world, (N, ns, 3), m."""
    n, ns = len(frames.origins), len(model.radii)
    centres = np.empty((n, ns, 3))
    for joint in np.unique(model.carrier):
        mine = model.carrier == joint
        local = model.centres[mine]
        if joint < 0:
            centres[:, mine] = local
        else:
            turned = local @ np.swapaxes(frames.rotations[:, joint], 1, 2)
            centres[:, mine] = frames.origins[:, joint, None] + turned
    return centres


def tip_pose(model: Model, q: Array) -> tuple[Array, Array]:
    """Rotation (3, 3) and position (3,) of the end effector at coordinates ``q``."""
    _, joint, rotation, translation = model.tip
    if joint < 0:
        return rotation, translation
    frames = forward(model, model.joint_values(q[None]))
    base_r, base_p = frames.rotations[0, joint], frames.origins[0, joint]
    return base_r @ rotation, base_p + base_r @ translation
