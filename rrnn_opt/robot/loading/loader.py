"""Robots from URDF files and pinocchio models; only here is pinocchio known.

Limits that the file lacks are assumed (:mod:`rrnn_opt.robot.loading.limits`), and the
robot's ``source`` says for which joints; replace ``robot.limits`` to use others.
"""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.arguments import checked
from rrnn_opt.errors import RobotError
from rrnn_opt.robot.data import RobotData
from rrnn_opt.robot.loading.body import collision_body
from rrnn_opt.robot.loading.limits import assumed, stated_limits
from rrnn_opt.robot.loading.restrict import restrict
from rrnn_opt.robot.loading.urdf import Urdf, read_urdf
from rrnn_opt.robot.tree import (
    BASE,
    CONTINUOUS,
    PRISMATIC,
    REVOLUTE,
    Array,
    Frame,
    JointTree,
    frozen,
    indices,
)

UNIT = 1e-9  # how far the length of an axis may be from one
_stderr = threading.Lock()


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep what C++ writes to file descriptor 2 away from the user."""
    with _stderr:
        sys.stderr.flush()
        try:
            saved = os.dup(2)
        except OSError:  # no standard error to keep quiet
            yield
            return
        nowhere = os.open(os.devnull, os.O_WRONLY)
        try:
            os.dup2(nowhere, 2)
            yield
        finally:
            os.dup2(saved, 2)
            os.close(saved)
            os.close(nowhere)


@checked(skip=["tips"])
def from_urdf(
    path: str | Path,
    *,
    tip: str | None = None,
    tips: Sequence[str] = (),
    spheres: str | Path | None = None,
    locked: Mapping[str, float] | None = None,
) -> RobotData:
    """The joints of a URDF between its root and the link ``tip``, or ``tips``.

    All other joints stand at their ``locked`` value (default 0) and their links
    are fixed bodies; joints that mimic a moving one follow it.

    Args:
        path: the URDF file.
        tip: end-effector link; without it the last leaf link of the file that
            a joint moves.
        tips: links of several arms that move at once, in place of ``tip``; the
            first is the robot's tip, of which tip goals speak.
        spheres: collision-sphere file; without it the spheres, cylinders and
            boxes of the collision geometry are covered.
        locked: values of joints that do not move, rad or m.

    Returns:
        The robot; ``cover["missing"]`` lists links whose collision geometry
        has no spheres.

    Raises:
        RobotError: in one sentence, what is wrong with the file or a name.
    """
    urdf = read_urdf(path)
    model = _model(urdf)
    whole = _whole(model, urdf.path)
    held = {name: float(value) for name, value in (locked or {}).items()}
    ends = _ends(whole, urdf, held, tip, tips)
    robot = restrict(whole, tips=ends, locked=held, mimic=urdf.mimic)
    source = f"{urdf.path}{assumed(model, robot)}"
    named = replace(robot, name=urdf.name, source=source)
    return collision_body(named, urdf, spheres)


def from_pinocchio(model: Any, *, tip: str | None = None) -> RobotData:
    """All joints of a ``pin.Model`` as a tree; no attribute is hung on it.

    Args:
        model: the model; without free-flyer, its joints of one degree of freedom.
        tip: frame name; the model's last frame without it.

    Returns:
        The robot, without spheres.

    Raises:
        RobotError: a joint is of another type, or there is no such frame.
    """
    whole = _whole(model, str(model.name))
    if tip is not None:
        whole = replace(whole, tip=whole.frame(tip).name)
    return replace(whole, source=f"pinocchio model{assumed(model, whole)}")


def _ends(
    whole: RobotData,
    urdf: Urdf,
    held: Mapping[str, float],
    tip: str | None,
    tips: Sequence[str],
) -> tuple[str, ...]:
    if isinstance(tips, str) or (tip is not None and tips):
        raise RobotError(urdf.path, "give either one 'tip' or a sequence of 'tips'")
    if tips:
        return tuple(tips)
    return (_default_tip(whole, urdf, held) if tip is None else tip,)


def _default_tip(whole: RobotData, urdf: Urdf, held: Mapping[str, float]) -> str:
    """The last leaf with a joint on the way that is neither held nor mimics."""
    led = {*held, *urdf.mimic}
    for leaf in reversed(urdf.leaves):
        way = whole.tree.ancestors(whole.frame(leaf).joint)
        if any(whole.joint_names[k] not in led for k in way):
            return leaf
    return urdf.leaves[-1]


def _model(urdf: Urdf) -> Any:
    import pinocchio as pin

    with _quiet():
        try:
            return pin.buildModelFromXML(urdf.text)
        except (ValueError, RuntimeError) as error:
            first = str(error).strip().splitlines()
            reason = first[0] if first else "no reason given"
            raise RobotError(urdf.path, f"pinocchio refuses it: {reason}") from None


def _whole(model: Any, source: str) -> RobotData:
    """Every joint of a model as a coordinate of its own."""
    joints = [_joint(model, k, source) for k in range(1, model.njoints)]
    types = tuple(kind for kind, _ in joints)
    n, placements = (
        len(types),
        [model.jointPlacements[k + 1] for k in range(len(types))],
    )
    own = indices(range(n))
    frames = tuple(_frames(model))
    poses = [pose.homogeneous for pose in placements]
    if not all(np.all(np.isfinite(pose)) for pose in poses):
        raise RobotError(source, "a joint's origin is not finite")
    return RobotData(
        name=str(model.name),
        joint_names=tuple(model.names)[1:],
        tree=JointTree(
            parents=indices([parent - 1 for parent in list(model.parents)[1:]]),
            types=types,
            placements=frozen(poses if n else np.zeros((0, 4, 4)), (n, 4, 4), "poses"),
            axes=frozen([a for _, a in joints] or np.zeros((0, 3)), (n, 3), "axes"),
            source=own,
            multiplier=frozen(np.ones(n), (n,), "multiplier"),
            offset=frozen(np.zeros(n), (n,), "offset"),
        ),
        limits=stated_limits(model, types),
        frames=frames,
        tip=frames[-1].name if frames else "",
    )


def _joint(model: Any, k: int, source: str) -> tuple[str, Array]:
    """Type and unit axis of a model's joint, from its motion subspace."""
    joint = model.joints[k]
    if joint.nv == 1 and "Mimic" not in joint.shortname():
        data = joint.createData()
        joint.calc(data, np.eye(joint.nq)[0])
        subspace = np.asarray(data.S, dtype=float).reshape(6)
        linear, angular = subspace[:3], subspace[3:]
        if not abs(np.linalg.norm(subspace) - 1.0) < UNIT:
            raise RobotError(source, f"joint '{model.names[k]}' has no unit axis")
        if not np.any(linear):
            return (CONTINUOUS if joint.nq == 2 else REVOLUTE), angular
        if not np.any(angular):
            return PRISMATIC, linear
    name, kind = model.names[k], joint.shortname()
    message = f"joint '{name}' is a {kind}; only revolute, continuous and prismatic"
    raise RobotError(source, f"{message} joints are supported")


def _frames(model: Any) -> Iterator[Frame]:
    import pinocchio as pin

    seen: set[str] = set()
    for frame in model.frames:
        named = frame.type in (pin.FrameType.BODY, pin.FrameType.OP_FRAME)
        if named and frame.name not in seen:
            seen.add(frame.name)
            pose = frozen(frame.placement.homogeneous, (4, 4), frame.name)
            carrier = int(frame.parentJoint) - 1
            yield Frame(frame.name, carrier if carrier >= 0 else BASE, pose)
