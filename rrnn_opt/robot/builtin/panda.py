"""The Franka Emika Panda with its hand, fingers held open at 0.065 m.

Joints, spheres, disabled pairs and position limits are those of the
description that MotionBenchMaker's problems are posed for (see data/NOTICE.md).
All joint placements are quarter turns, so their rotation entries are 0 or +-1
exactly; only the hand is fixed at -45 degrees.
"""

from __future__ import annotations

import json
from importlib import resources
from math import degrees
from typing import Any

import numpy as np

from rrnn_opt.robot.builtin.parts import chain, frame, limits
from rrnn_opt.robot.data import RobotData
from rrnn_opt.robot.placement import compose, shift, turn
from rrnn_opt.robot.sphere_file import SphereFile, checked_pairs, placed_spheres
from rrnn_opt.robot.tree import Array, Frame

VELOCITY = (2.175,) * 4 + (2.61,) * 3  # rad/s
ACCELERATION = (15.0, 7.5, 10.0, 12.5, 15.0, 20.0, 20.0)  # rad/s2
FRANKA_LOWER = (-2.8973, -1.7628, -2.8973, -3.0718, -2.8973, -0.0175, -2.8973)
FRANKA_UPPER = (2.8973, 1.7628, 2.8973, -0.0698, 2.8973, 3.7525, 2.8973)
SOURCE = (
    "joints, spheres, disabled pairs and position limits: the Panda of VAMP 0.6.4 and"
    " MotionBenchMaker; velocity and acceleration: Franka's FCI limits; Franka's own"
    f" position limits are tighter: {list(FRANKA_LOWER)} to {list(FRANKA_UPPER)} rad"
)
LICENCE = "Apache-2.0 (VAMP; franka_ros)"


def _placement(joint: dict[str, Any]) -> Array:
    """Pose of a joint from xyz and roll, pitch, yaw; rounded to 1e-6 degrees."""
    roll, pitch, yaw = (round(degrees(angle), 6) for angle in joint["rpy"])
    rotation = compose(turn("z", yaw), turn("y", pitch), turn("x", roll))
    return compose(shift(*joint["xyz"]), rotation)


def _link_frames(joints: list[dict[str, Any]]) -> dict[str, Frame]:
    """Frame of every link on the moving joint that carries it."""
    frames = {"panda_link0": frame("panda_link0", -1, np.eye(4))}
    moving = 0
    for joint in joints:
        parent, child = frames[joint["parent"]], joint["child"]
        if joint["type"] == "revolute":
            frames[child] = frame(child, moving, np.eye(4))
            moving += 1
        else:
            pose = compose(parent.placement, _placement(joint))
            frames[child] = frame(child, parent.joint, pose)
    return frames


def robot() -> RobotData:
    """The arm with 59 spheres and the tip 0.105 m beyond the hand."""
    folder = resources.files("rrnn_opt.robot.builtin") / "data"
    data = json.loads((folder / "panda_spheres.json").read_text(encoding="utf-8"))
    moving = [joint for joint in data["joints"] if joint["type"] == "revolute"]
    frames = _link_frames(data["joints"])
    file = SphereFile.from_data(data)
    spheres = placed_spheres(file.links, frames)
    return RobotData(
        name="panda",
        joint_names=tuple(joint["name"] for joint in moving),
        tree=chain([_placement(j) for j in moving], [j["axis"] for j in moving]),
        limits=limits(
            [joint["limit"]["lower"] for joint in moving],
            [joint["limit"]["upper"] for joint in moving],
            VELOCITY,
            ACCELERATION,
        ),
        frames=tuple(frames.values()),
        tip="panda_grasptarget",
        spheres=spheres,
        self_pairs=checked_pairs(spheres, file.disabled or frozenset()),
        source=SOURCE,
        licence=LICENCE,
    )
