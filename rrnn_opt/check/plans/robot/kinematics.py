"""Forward kinematics of many configurations at once, from plain arrays."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rrnn_opt.check.arithmetic.sincos import sincos
from rrnn_opt.check.plans.reading import Array
from rrnn_opt.check.plans.robot.model import Model


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


def turn_forms(model: Model) -> Array:
    """The three matrices whose sum is a joint's frame in its parent's.

    ``P (a a' + cos (I - a a') + sin [a]x)``, P the placement and a the axis; a
    slide does not turn, its first matrix is P and the others are zero.

    Returns:
        (nj, 3, 3, 3).
    """
    p, a = model.rotation, model.axes
    x, y, z = a.T
    zero = np.zeros_like(x)
    cross = np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]])
    along = np.einsum("kij,kj->ki", p, a)[:, :, None] * a[:, None, :]
    forms = np.stack([along, p - along, p @ np.moveaxis(cross, 2, 0)], axis=1)
    forms[model.prismatic] = 0.0
    forms[model.prismatic, 0] = p[model.prismatic]
    return forms


def forward(model: Model, joints: Array) -> Frames:
    """Frames of all joints.

    Args:
        model: the robot.
        joints: joint values (not coordinates), (N, nj), rad or m.
    """
    n = len(joints)
    rotations = np.empty((model.nj, n, 3, 3))
    origins, axes = np.empty((model.nj, n, 3)), np.empty((model.nj, n, 3))
    turned = _turned(model, joints)
    slides = np.einsum("kij,kj->ki", model.rotation, model.axes)
    for k, parent in enumerate(model.parents):
        if parent < 0:
            rotations[k], axes[k] = turned[k], slides[k]
            origins[k] = model.translation[k]
        else:
            base = rotations[parent]
            np.matmul(base, turned[k], out=rotations[k])
            axes[k] = base @ slides[k]
            origins[k] = origins[parent] + base @ model.translation[k]
        if model.prismatic[k]:
            origins[k] += joints[:, k, None] * axes[k]
    return Frames(
        np.moveaxis(rotations, 0, 1), np.moveaxis(origins, 0, 1), axes.swapaxes(0, 1)
    )


def _turned(model: Model, joints: Array) -> Array:
    """Each joint's frame in its parent's, (nj, N, 3, 3)."""
    sine, cosine = sincos(joints.T)
    forms = turn_forms(model)[:, :, None]
    turned: Array = forms[:, 1] * cosine[..., None, None]
    turned += forms[:, 2] * sine[..., None, None]
    turned += forms[:, 0]
    return turned


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
