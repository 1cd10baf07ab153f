"""How far a joint can move a sphere: proved bounds over the joint box.

With R[k, i] from ``reach``, a motion in which joint k turns (or slides) by at
most |dq_k| moves sphere i by at most sum_k R[k, i] |dq_k|.  Between two joint
axes the arm is rigid, so a distance is bounded by the sum of the rigid pieces;
two pieces v, w that meet at a revolute joint with axis a are bounded together,

    |v + Rot(a, t) w|^2 <= (v.a + w.a)^2 + (|v - (v.a) a| + |w - (w.a) a|)^2,

with equality for some angle t.  Prismatic joints lengthen a piece; the bound is
convex in their positions, so it is taken at the ends of their ranges.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.errors import RobotError
from rrnn_opt.robot.robot import Robot
from rrnn_opt.robot.tree import BASE, PRISMATIC, Array

_ROUND_UP = 1.0 + 1e-13


@dataclass(frozen=True, eq=False)
class _Piece:
    """A rigid piece between two revolute axes, in its first joint's frame.

    Attributes:
        ends: vectors to its end for the extreme prismatic positions, (m, 3), m.
        first_axis: axis of the joint at its start, (3,).
        last_axis: axis of the joint at its end, (3,); zero for the last piece.
    """

    ends: Array
    first_axis: Array
    last_axis: Array


def joint_range(robot: Robot, joint: int) -> tuple[float, float]:
    """Least and largest value of a tree joint, through its coupling; rad or m."""
    tree, i = robot.tree, int(robot.tree.source[joint])
    ends = (
        float(tree.multiplier[joint] * bound[i] + tree.offset[joint])
        for bound in (robot.limits.lower, robot.limits.upper)
    )
    low, high = sorted(ends)
    return low, high


def _slide_ends(robot: Robot, joint: int) -> Array:
    ends = joint_range(robot, joint)
    if not np.all(np.isfinite(ends)):
        raise RobotError(
            robot.name,
            f"prismatic joint {joint} is unlimited, so nothing bounds its reach;"
            " give it position limits",
        )
    return np.outer(ends, robot.tree.axes[joint])


def _pieces(
    robot: Robot, joint: int, path: Sequence[int], point: Array
) -> list[_Piece]:
    """Rigid pieces from a joint's frame over the joints of ``path`` to a point."""
    tree, pieces = robot.tree, []
    ends, rotation = np.zeros((1, 3)), np.eye(3)
    first_axis = tree.axes[joint] if joint != BASE else np.zeros(3)
    for k in path:
        ends = ends + rotation @ tree.placements[k][:3, 3]
        rotation = rotation @ tree.placements[k][:3, :3]
        if tree.types[k] == PRISMATIC:
            slides = _slide_ends(robot, k) @ rotation.T
            ends = (ends[:, None, :] + slides[None, :, :]).reshape(-1, 3)
        else:
            pieces.append(_Piece(ends, first_axis, rotation @ tree.axes[k]))
            ends, rotation, first_axis = np.zeros((1, 3)), np.eye(3), tree.axes[k]
    pieces.append(_Piece(ends + rotation @ point, first_axis, np.zeros(3)))
    return pieces


def _across(vectors: Array, axis: Array) -> Array:
    """Lengths of the parts of the vectors that are perpendicular to an axis."""
    flat: Array = np.linalg.norm(vectors - np.outer(vectors @ axis, axis), axis=1)
    return flat


def _pair(first: _Piece, second: _Piece) -> float:
    """Largest length of two pieces that meet at a revolute joint."""
    along = (first.ends @ first.last_axis)[:, None] + second.ends @ second.first_axis
    across = _across(first.ends, first.last_axis)[:, None]
    across = across + _across(second.ends, second.first_axis)
    return float(np.max(np.hypot(along, across)))


def _length(pieces: Sequence[_Piece], *, from_axis: bool) -> float:
    """Bound of the chain's length; ``from_axis``: of the distance to the axis.

    The least sum over all ways to take the pieces singly or in pairs.
    """
    before, best = 0.0, 0.0
    for i, piece in enumerate(pieces):
        single = float(np.max(np.linalg.norm(piece.ends, axis=1)))
        if i == 0 and from_axis:
            single = float(np.max(_across(piece.ends, piece.first_axis)))
        options = [best + single]
        if i > 0:
            options.append(before + _pair(pieces[i - 1], piece))
        before, best = best, min(options)
    return best * _ROUND_UP


def ancestor_mask(robot: Robot) -> NDArray[np.bool_]:
    """Which tree joint moves which sphere, (nj, ns)."""
    mask = np.zeros((robot.tree.nj, len(robot.spheres)), dtype=bool)
    for i, sphere in enumerate(robot.spheres):
        mask[list(robot.tree.ancestors(sphere.joint)), i] = True
    return mask


def reach(robot: Robot) -> Array:
    """Largest speed of every sphere's centre per unit speed of every joint.

    For a revolute joint k it is an upper bound, over the joint box, of the
    distance from the joint's axis to the centre, m; for a prismatic joint 1;
    where joint k does not move sphere i it is 0.

    Args:
        robot: the robot.

    Returns:
        R, (nj, ns); a row for every tree joint, mimic joints included.

    Raises:
        RobotError: a prismatic joint that a revolute one carries is unlimited.
    """
    tree = robot.tree
    out = np.zeros((tree.nj, len(robot.spheres)))
    for i, sphere in enumerate(robot.spheres):
        path = tree.ancestors(sphere.joint)
        for depth, k in enumerate(path):
            if tree.types[k] == PRISMATIC:
                out[k, i] = 1.0
                continue
            pieces = _pieces(robot, k, path[depth + 1 :], sphere.center)
            out[k, i] = _length(pieces, from_axis=True)
    return out


def reach_ball(robot: Robot, frame: str | None = None) -> tuple[Array, float]:
    """A ball in the base that a frame's origin cannot leave.

    Its centre is a point that no joint moves: the first origin on the way, or
    the second when it lies on the first axis.

    Args:
        robot: the robot.
        frame: name of the frame; the tip without a name.

    Returns:
        Centre, (3,), m, and radius, m.

    Raises:
        RobotError: there is no such frame, or a prismatic joint on the way is
            unlimited.
    """
    where = robot.frame(frame)
    path = robot.tree.ancestors(where.joint)
    pieces = _pieces(robot, BASE, path, where.placement[:3, 3])
    fixed = pieces[0].ends
    if len(fixed) > 1 or len(pieces) == 1:
        return fixed[0] * 0.0, _length(pieces, from_axis=False)
    centre, rest = fixed[0], pieces[1:]
    if len(rest) > 1 and len(rest[0].ends) == 1 and not _off_axis(rest[0]):
        centre = centre + (rest[0].ends[0] @ rest[0].first_axis) * pieces[0].last_axis
        rest = rest[1:]
    return centre, _length(rest, from_axis=False)


def _off_axis(piece: _Piece) -> bool:
    return bool(np.max(_across(piece.ends, piece.first_axis)) > 0.0)


def tip_reach(robot: Robot, frame: str | None = None) -> float:
    """Largest distance of a frame's origin from the first joint's origin, m.

    The first joint's origin is where it stands at joint value zero.  A goal
    position farther away than this is out of reach; ``reach_ball`` is tighter.

    Raises:
        RobotError: there is no such frame, or a prismatic joint on the way is
            unlimited.
    """
    where = robot.frame(frame)
    path = robot.tree.ancestors(where.joint)
    if not path:
        return 0.0
    pieces = _pieces(robot, BASE, path, where.placement[:3, 3])
    start = robot.tree.placements[path[0]][:3, 3]
    moved = _Piece(pieces[0].ends - start, pieces[0].first_axis, pieces[0].last_axis)
    return _length([moved, *pieces[1:]], from_axis=False)
