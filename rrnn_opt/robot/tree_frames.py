"""Frames of a tree of joints, in CasADi SX: the recursion of ``Kinematics``.

CasADi drops multiplications by exact 0 and 1 as the graph is built, so exact
placements give a lean graph.
"""

from __future__ import annotations

from collections.abc import Sequence

import casadi as ca

from rrnn_opt.robot.rotation import rotation_about
from rrnn_opt.robot.tree import BASE, PRISMATIC, Array, JointTree

Pose = tuple[ca.SX, ca.SX]
"""Rotation (3, 3) and origin (3, 1), m, in the base."""


def tree_frames(tree: JointTree, q: ca.SX) -> list[Pose]:
    """Frame of every joint after its motion; q is (nv, 1), rad or m."""
    frames: list[Pose] = []
    for k in range(tree.nj):
        value = tree.multiplier[k] * q[int(tree.source[k])] + tree.offset[k]
        R, p = carried(frames, int(tree.parents[k]), tree.placements[k])
        if tree.types[k] == PRISMATIC:
            p = p + (R @ ca.SX(tree.axes[k])) * value
        else:
            R = R @ rotation_about(tree.axes[k], value)
        frames.append((R, p))
    return frames


def carried(frames: Sequence[Pose], joint: int, placement: Array) -> Pose:
    """A placement (4, 4) fixed to a joint's frame, or to the base."""
    R, p = ca.SX(placement[:3, :3]), ca.SX(placement[:3, 3])
    if joint == BASE:
        return R, p
    R_joint, p_joint = frames[joint]
    return R_joint @ R, p_joint + R_joint @ p
