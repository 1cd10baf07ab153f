"""From a whole tree to the joints that move a frame; the others are held."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rrnn_opt.errors import RobotError
from rrnn_opt.robot.data import RobotData
from rrnn_opt.robot.loading.urdf import Mimic
from rrnn_opt.robot.tree import (
    BASE,
    PRISMATIC,
    Array,
    Frame,
    JointTree,
    Limits,
    frozen,
    indices,
)


@dataclass(frozen=True)
class _Drive:
    """Coordinate that drives a joint (None: none does) and its coupling."""

    source: str | None
    multiplier: float
    offset: float


def axis_motion(kind: str, axis: Array, value: float) -> Array:
    """Motion of a joint by a value along or about its axis, (4, 4), rad or m."""
    pose = np.eye(4)
    if kind == PRISMATIC:
        pose[:3, 3] = value * axis
        return pose
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    pose[:3, :3] += np.sin(value) * cross + (1.0 - np.cos(value)) * (cross @ cross)
    return pose


def restrict(
    whole: RobotData,
    *,
    tips: Sequence[str],
    locked: Mapping[str, float],
    mimic: Mapping[str, Mimic],
) -> RobotData:
    """The robot whose coordinates are the joints between the base and ``tips``.

    They come in the order of the tips, each tip's from the base outwards; a
    joint on the way to several tips comes once.

    Joints that mimic one of them follow it, wherever they are in the tree; all
    others stand at their locked value (0 when none is given; a mimic joint at
    what its source's value says) and their links become fixed bodies on the
    nearest moving joint.  A locked joint never moves, on the way or not.

    Args:
        whole: a robot with one coordinate a joint, named alike.
        tips: frame names, one or more; the first is the robot's tip.
        locked: values of joints that do not move, rad or m.
        mimic: couplings.

    Returns:
        The restricted robot, without spheres.

    Raises:
        RobotError: unknown frame or locked joint, no moving joint, an empty
            range of a moving joint, or joints that mimic in a circle.
    """
    names = whole.joint_names
    _check_locked(whole, locked)
    ways = [whole.tree.ancestors(whole.frame(tip).joint) for tip in tips]
    way = dict.fromkeys(names[k] for one in ways for k in one)
    moving = [name for name in way if name not in locked and name not in mimic]
    drives = {name: _drive(whole, name, moving, locked, mimic) for name in names}
    moving = [name for name in moving if drives[name].source is not None]
    if not moving:
        frames = ", ".join(f"'{tip}'" for tip in tips)
        raise RobotError(whole.name, f"no joint moves the frame {frames}")
    carriers, kept = _carriers(whole.tree, [drives[name] for name in names])
    return replace(
        whole,
        joint_names=tuple(moving),
        tree=_tree(whole, moving, drives, carriers, kept),
        limits=_limits(whole, [names.index(name) for name in moving]),
        frames=tuple(_frame(frame, carriers) for frame in whole.frames),
        tip=tips[0],
    )


def _check_locked(whole: RobotData, locked: Mapping[str, float]) -> None:
    for name, value in locked.items():
        if name not in whole.joint_names:
            known = ", ".join(whole.joint_names)
            raise RobotError(whole.name, f"no joint '{name}' to lock; it has {known}")
        if not np.isfinite(value):
            raise RobotError(whole.name, f"locked joint '{name}' needs a finite value")


def _drive(
    whole: RobotData,
    name: str,
    moving: Iterable[str],
    locked: Mapping[str, float],
    mimic: Mapping[str, Mimic],
) -> _Drive:
    """Follow the mimic couplings to a moving joint or to a fixed value."""
    multiplier, offset, at, seen = 1.0, 0.0, name, {name}
    while at in mimic and at not in locked:
        follows = mimic[at]
        offset += multiplier * follows.offset
        multiplier *= follows.multiplier
        at = follows.source
        if at in seen:
            raise RobotError(whole.name, f"joint '{name}' mimics itself in a circle")
        seen.add(at)
    if at in moving:
        return _Drive(at, multiplier, offset)
    return _Drive(None, 0.0, multiplier * locked.get(at, 0.0) + offset)


Carrier = tuple[int, Array]


def _carriers(
    tree: JointTree, drives: list[_Drive]
) -> tuple[dict[int, Carrier], list[int]]:
    """New joint and pose in it of every old joint frame; the joints kept."""
    carriers: dict[int, Carrier] = {BASE: (BASE, np.eye(4))}
    kept: list[int] = []
    for k, drive in enumerate(drives):
        if drive.source is not None:
            carriers[k] = (len(kept), np.eye(4))
            kept.append(k)
        else:
            joint, pose = carriers[int(tree.parents[k])]
            motion = axis_motion(tree.types[k], tree.axes[k], drive.offset)
            carriers[k] = (joint, pose @ tree.placements[k] @ motion)
    return carriers, kept


def _tree(
    whole: RobotData,
    moving: list[str],
    drives: Mapping[str, _Drive],
    carriers: Mapping[int, Carrier],
    kept: list[int],
) -> JointTree:
    old, n = whole.tree, len(kept)
    held = [carriers[int(old.parents[k])] for k in kept]
    used = [drives[whole.joint_names[k]] for k in kept]
    poses = [p @ old.placements[k] for (_, p), k in zip(held, kept, strict=True)]
    return JointTree(
        parents=indices([joint for joint, _ in held]),
        types=tuple(old.types[k] for k in kept),
        placements=frozen(poses, (n, 4, 4), "placements"),
        axes=frozen(old.axes[kept], (n, 3), "axes"),
        source=indices([moving.index(str(d.source)) for d in used]),
        multiplier=frozen([d.multiplier for d in used], (n,), "multiplier"),
        offset=frozen([d.offset for d in used], (n,), "offset"),
    )


def _limits(whole: RobotData, indices: list[int]) -> Limits:
    old, n = whole.limits, len(indices)
    for i in indices:
        if not old.lower[i] < old.upper[i]:
            name, low, high = whole.joint_names[i], old.lower[i], old.upper[i]
            raise RobotError(
                whole.name,
                f"joint '{name}' has the empty range [{low:g}, {high:g}];"
                " give it limits or lock it",
            )
    fields = (old.lower, old.upper, old.velocity, old.acceleration)
    return Limits(*(frozen(field[indices], (n,), "limits") for field in fields))


def _frame(frame: Frame, carriers: Mapping[int, Carrier]) -> Frame:
    joint, pose = carriers[frame.joint]
    placement = frozen(pose @ frame.placement, (4, 4), frame.name)
    return replace(frame, joint=joint, placement=placement)
