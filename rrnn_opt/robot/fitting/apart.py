"""Proof that the geometry of two links never touches, by branch and bound.

Only the joints between the links matter.  A turn of joint k by dq_k changes the
distance of a point of one link to a point of the other by no more than R_k |dq_k|,
with R_k an upper bound of the distance from its axis to the geometry on either side
of it.  So over a box of joint values with half edges h about a middle m a distance
d(m) > sum_k R_k h_k proves the whole box, d(m) = 0 refutes, and any other box is
halved where R_k h_k is largest.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import casadi as ca
import numpy as np

from rrnn_opt.robot.fitting.geometry import Gap, Geometry
from rrnn_opt.robot.kinematics import Kinematics
from rrnn_opt.robot.reach import joint_range
from rrnn_opt.robot.robot import Robot
from rrnn_opt.robot.tree import PRISMATIC, Array

MOST_BOXES = 4000


@dataclass(frozen=True)
class Apart:
    """What is known of two links.

    Attributes:
        verdict: "apart" is proved, "touching" has a posture that shows it.
        gap: least distance seen, m.
        boxes: looked at.
    """

    verdict: Literal["apart", "touching", "undecided"]
    gap: float
    boxes: int


def path_joints(robot: Robot, first: str, second: str) -> list[int]:
    """Tree joints between two links, from the first to the second."""
    up = robot.tree.ancestors(robot.frame(first).joint)
    down = robot.tree.ancestors(robot.frame(second).joint)
    mine, theirs = sorted(set(up) - set(down)), sorted(set(down) - set(up))
    return [*reversed(mine), *theirs]


def never_touch(
    robot: Robot,
    first: str,
    second: str,
    geometry: Mapping[str, list[Geometry]],
    *,
    most: int = MOST_BOXES,
) -> Apart:
    """Whether two links are apart in every posture between the joint limits.

    Args:
        robot: the robot; joints without limits turn once around.
        first: a link.
        second: another one.
        geometry: of both.
        most: boxes looked at before giving up.
    """
    lever = levers(robot, first, second, geometry)
    gap = Gap(geometry[first], geometry[second])
    kin = Kinematics(robot)
    both = ca.Function("both", [kin.q], [kin.pose(first), kin.pose(second)])
    low = np.where(np.isfinite(robot.limits.lower), robot.limits.lower, -np.pi)
    high = np.where(np.isfinite(robot.limits.upper), robot.limits.upper, np.pi)
    boxes = [(0.5 * (low + high), np.where(lever > 0.0, 0.5 * (high - low), 0.0))]
    least, looked = np.inf, 0
    while boxes:
        if looked == most:
            return Apart("undecided", least, looked)
        middle, half = boxes.pop()
        distance = gap.at(*(np.array(pose) for pose in both(middle)))
        looked, least = looked + 1, min(least, distance)
        if distance <= 0.0:
            return Apart("touching", distance, looked)
        if distance <= float(lever @ half):
            boxes += _split(middle, half, int(np.argmax(lever * half)))
    return Apart("apart", least, looked)


def _split(middle: Array, half: Array, k: int) -> list[tuple[Array, Array]]:
    narrow, shift = half.copy(), np.zeros_like(half)
    narrow[k] = shift[k] = 0.5 * half[k]
    return [(middle - shift, narrow), (middle + shift, narrow)]


def levers(
    robot: Robot, first: str, second: str, geometry: Mapping[str, list[Geometry]]
) -> Array:
    """How fast each coordinate can change the distance of points of both links, (nv,).

    m/rad or 1; zero for coordinates that do not move the links against each other.
    """
    path = path_joints(robot, first, second)
    lever = np.zeros(robot.nv)
    one = _outwards(robot, path, first, geometry[first])
    other = _outwards(robot, path[::-1], second, geometry[second])[::-1]
    for k, a, b in zip(path, one, other, strict=True):
        turned = 1.0 if robot.tree.types[k] == PRISMATIC else min(a, b)
        lever[int(robot.tree.source[k])] += abs(robot.tree.multiplier[k]) * turned
    return lever


def _outwards(
    robot: Robot, path: list[int], link: str, pieces: list[Geometry]
) -> list[float]:
    """Bounds of the distance of a link's geometry to the axes of a path's joints.

    The path begins at the link; exact for its first joint, for the others by the
    lengths of the chain.
    """
    tree, frame = robot.tree, robot.frame(link)
    points = np.concatenate([piece.extremes() for piece in pieces])
    points = points @ frame.placement[:3, :3].T + frame.placement[:3, 3]
    here, far = frame.joint, float(np.linalg.norm(points, axis=1).max())
    bounds: list[float] = []
    for k in path:
        up = here == k
        offset = np.zeros(3) if up else tree.placements[k][:3, 3]
        far += float(np.linalg.norm(offset))
        if bounds:
            bounds.append(far)
        else:
            axis = tree.axes[k] if up else tree.placements[k][:3, :3] @ tree.axes[k]
            across = (points - offset) - np.outer((points - offset) @ axis, axis)
            bounds.append(float(np.linalg.norm(across, axis=1).max()))
        far += _stroke(robot, k)
        if up:
            far += float(np.linalg.norm(tree.placements[k][:3, 3]))
        here = int(tree.parents[k]) if up else k
    return bounds


def _stroke(robot: Robot, joint: int) -> float:
    """How far a joint can shift what it carries, m."""
    if robot.tree.types[joint] != PRISMATIC:
        return 0.0
    return float(np.abs(joint_range(robot, joint)).max())
