"""Problem documents that tests share."""

import copy

import numpy as np

from rrnn_opt.robot.robot import Robot
from rrnn_opt.robot.tree import Frame, JointTree, Limits, Sphere

VALID = {
    "name": "reach round a post",
    "robot": "planar3",
    "frame": "tip",
    "locked": {},
    "start": [0.1, 0.2, 0.3],
    "goal": [
        {"joints": [1, 1, 1]},
        {"position": [1, 1, 0]},
        {
            "position": [1.5, 1, 0],
            "tolerance": 0.01,
            "quat_xyzw": [0, 0, 0.6, 0.8],
            "angle_tolerance": 0.1,
        },
    ],
    "obstacles": [
        {
            "name": "b",
            "type": "box",
            "size": [0.1, 0.2, 0.3],
            "position": [2, 0, 0],
        },
        {"type": "cylinder", "radius": 0.1, "length": 0.2, "position": [2, 0, 1]},
        {
            "type": "capsule",
            "radius": 0.1,
            "length": 1,
            "position": [0, 2, 1],
            "quat_xyzw": [0.6, 0, 0, 0.8],
        },
        {"type": "sphere", "radius": 0.1, "position": [2, 0, 1]},
        {"type": "halfspace", "normal": [0, 0, 1], "offset": -0.5},
    ],
    "margin": 0.01,
}


def valid():
    return copy.deepcopy(VALID)


def changed(*path_and_value):
    """The valid problem with the entry at a path set (or, at ..., removed)."""
    *path, key, value = path_and_value
    problem = at = valid()
    for step in path:
        at = at[step]
    if value is ...:
        del at[key]
    else:
        at[key] = value
    return problem


def minimal():
    return {"robot": "planar3", "start": [0, 0, 0], "goal": {"position": [1, 1, 0]}}


def one_joint(kind, low, high, spheres=True):
    """A robot of one joint at the origin, with a ball of 5 cm on its tip."""
    row = np.array([1.0])
    tree = JointTree(
        parents=np.array([-1]),
        types=(kind,),
        placements=np.eye(4)[None],
        axes=np.array([[0.0, 0.0, 1.0]]),
        source=np.array([0]),
        multiplier=row,
        offset=0 * row,
    )
    limits = Limits(np.array([low]), np.array([high]), row, row)
    ball = Sphere("arm", 0, np.array([1.0, 0.0, 0.0]), 0.05)
    frames = (Frame("tip", 0, np.eye(4)),)
    balls = (ball,) if spheres else ()
    return Robot("one", ("swing",), tree, limits, frames, "tip", balls)
