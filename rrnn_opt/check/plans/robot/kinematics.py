"""Forward kinematics of many configurations at once, from plain arrays."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rrnn_opt.check.arithmetic.sincos import sincos
from rrnn_opt.check.plans.reading import Array
from rrnn_opt.check.plans.robot.model import Model


class Frames(NamedTuple):
    """Joint frames in the world at N configurations.

    These come last: numbers of one kind stand side by side, so few calls do much.

    Attributes:
        rotations: (nj, 3, 3, N).
        origins: (nj, 3, N), m.
        axes: joint axes, (nj, 3, N).
    """

    rotations: Array
    origins: Array
    axes: Array


def forward(model: Model, joints: Array) -> Frames:
    """Frames of all joints.

    Args:
        model: the robot.
        joints: joint values (not coordinates), (nj, N), rad or m.
    """
    nj, n = joints.shape
    turned = _turned(model, joints)
    rotations = np.empty((nj + 1, 3, 3, n))
    rotations[nj] = np.eye(3)[:, :, None]  # the base: parent -1 is the last
    for k, parent in enumerate(model.parents):
        np.sum(rotations[parent][:, :, None] * turned[k], axis=1, out=rotations[k])
    bases = rotations[model.parents]
    axes = (bases * model.slides[:, None, :, None]).sum(axis=2)
    steps = (bases * model.translation[:, None, :, None]).sum(axis=2)
    steps[model.prismatic] += (joints[:, None] * axes)[model.prismatic]
    origins = np.zeros((nj + 1, 3, n))
    for k, parent in enumerate(model.parents):
        np.add(origins[parent], steps[k], out=origins[k])
    return Frames(rotations[:nj], origins[:nj], axes)


def _turned(model: Model, joints: Array) -> Array:
    """Each joint's frame in its parent's, (nj, 3, 3, N)."""
    sine, cosine = sincos(joints)
    forms = model.turn_forms[..., None]
    turned: Array = forms[:, 1] * cosine[:, None, None]
    turned += forms[:, 2] * sine[:, None, None]
    turned += forms[:, 0]
    return turned


def sphere_centres(model: Model, frames: Frames) -> Array:
    """Centres of all spheres in the world, (3, ns, N), m."""
    centres = np.empty((3, len(model.radii), frames.origins.shape[2]))
    for joint, mine in model.carried:
        local = model.centres[mine]
        if joint < 0:
            centres[:, mine] = local.T[:, :, None]
        else:
            turned = local @ frames.rotations[joint]
            centres[:, mine] = turned + frames.origins[joint][:, None]
    return centres


def tip_pose(model: Model, q: Array) -> tuple[Array, Array]:
    """Rotation (3, 3) and position (3,) of the end effector at coordinates ``q``."""
    _, joint, rotation, translation = model.tip
    if joint < 0:
        return rotation, translation
    frames = forward(model, model.joint_values(q[None]).T)
    base_r, base_p = frames.rotations[joint, ..., 0], frames.origins[joint, :, 0]
    return base_r @ rotation, base_p + base_r @ translation
