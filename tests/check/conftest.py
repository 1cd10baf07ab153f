"""Small robots as plain documents, and the whole built-in ones."""

import copy

import numpy as np
import pytest


def pose(xyz=(0.0, 0.0, 0.0), axis=(0.0, 0.0, 1.0), angle=0.0):
    """A 4 x 4 pose as nested lists."""
    x, y, z = np.asarray(axis) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix = np.eye(4)
    matrix[:3, :3] += np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    matrix[:3, 3] = xyz
    return matrix.tolist()


def sphere(link, joint, center=(0.0, 0.0, 0.0), radius=0.05):
    return {"link": link, "joint": joint, "center": list(center), "radius": radius}


TREE = {
    "name": "tree",
    "parents": [-1, 0, 1, 0, 3],
    "placements": [
        pose((0.1, 0.0, 0.3), (1, 1, 0), 0.3),
        pose((0.2, 0.1, 0.0), (0, 1, 0), -0.7),
        pose((0.3, 0.0, 0.1), (1, 0, 0), 1.1),
        pose((-0.2, 0.1, 0.2), (0, 1, 1), 0.4),
        pose((0.0, 0.25, 0.0), (1, 0, 1), 2.0),
    ],
    "axes": [[0, 0, 1], [1, 0, 0], [1 / 3, 2 / 3, -2 / 3], [0, 1, 0], [0, 0, 1]],
    "types": ["revolute", "prismatic", "revolute", "prismatic", "continuous"],
    "coupling": {
        "source": [0, 1, 2, 1, 3],
        "multiplier": [1.0, 1.0, 1.0, -0.5, 2.0],
        "offset": [0.0, 0.0, 0.2, 0.1, 0.0],
    },
    "joint_names": ["a", "b", "c", "d"],
    "tip": {"name": "hand", "joint": 2, "placement": pose((0.1, 0.2, 0.0))},
    "spheres": [
        sphere("base", -1, (0.0, 0.0, 0.1), 0.1),
        sphere("one", 0, (0.1, 0.0, 0.0)),
        sphere("two", 2, (0.1, 0.2, 0.05)),
        sphere("two", 2, (0.2, 0.2, 0.05), 0.04),
        sphere("three", 4, (0.05, -0.1, 0.2), 0.03),
    ],
    "self_pairs": [["two", "three"], ["base", "two"], ["base", "three"]],
    "limits": {
        "lower": [-3.0, -0.3, -3.0, None],
        "upper": [3.0, 0.4, 3.0, None],
        "velocity": [2.0, 0.5, 2.0, 3.0],
        "acceleration": [10.0, 2.0, 10.0, 10.0],
    },
}
"""Five joints in a tree: turns, slides, a coupled joint, odd axes."""


@pytest.fixture
def planar():
    """Two links of 1 m in the plane, a sphere at the end of each."""
    return {
        "name": "planar",
        "parents": [-1, 0],
        "placements": [pose(), pose((1.0, 0.0, 0.0))],
        "axes": [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0]],
        "types": ["revolute", "revolute"],
        "coupling": {"source": [0, 1], "multiplier": [1.0, 1.0], "offset": [0.0, 0.0]},
        "joint_names": ["a", "b"],
        "tip": {"name": "tip", "joint": 1, "placement": pose((1.0, 0.0, 0.0))},
        "spheres": [
            sphere("base", -1),
            sphere("upper", 0, (1.0, 0.0, 0.0)),
            sphere("lower", 1, (1.0, 0.0, 0.0)),
        ],
        "self_pairs": [["base", "lower"]],
        "limits": {
            "lower": [-3.0, -3.0],
            "upper": [3.0, 3.0],
            "velocity": [2.0, 2.0],
            "acceleration": [10.0, 10.0],
        },
    }


@pytest.fixture
def tree():
    return copy.deepcopy(TREE)


@pytest.fixture(params=["planar", "tree", "panda", "pa10", "planar3", "raven2"])
def robot(request):
    """Every robot that the checker must judge, as a document."""
    if request.param in ("planar", "tree"):
        return request.getfixturevalue(request.param)
    from rrnn_opt.robot import Robot

    return Robot.builtin(request.param).to_dict()
