import copy
import json

import numpy as np
import pytest

from rrnn_opt.errors import RobotError
from rrnn_opt.robot import Robot
from rrnn_opt.robot.builtin import BUILTIN

KEYS = ["name", "parents", "placements", "axes", "types", "coupling"]
KEYS += ["joint_names", "tip", "spheres", "self_pairs", "limits"]


@pytest.mark.parametrize("name", BUILTIN)
def test_data_survive_json_and_come_back(name):
    robot = Robot.builtin(name)
    text = json.dumps(robot.to_dict(), allow_nan=False)
    again = Robot.from_dict(json.loads(text))
    assert list(again.to_dict()) == KEYS
    assert again.to_dict() == robot.to_dict()
    assert again.sphere_pairs() == robot.sphere_pairs()
    assert again.nv == robot.nv


def test_infinite_limits_are_null():
    data = Robot.builtin("planar3").to_dict()
    data["limits"]["lower"][1] = data["limits"]["upper"][1] = None
    robot = Robot.from_dict(data)
    assert (robot.limits.lower[1], robot.limits.upper[1]) == (-np.inf, np.inf)
    assert robot.to_dict() == data


def test_arrays_cannot_be_written():
    robot = Robot.from_dict(Robot.builtin("planar3").to_dict())
    for array in (robot.tree.parents, robot.tree.axes, robot.limits.lower):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 1


def _without(data, key):
    del data[key]


BROKEN = {
    "is missing": lambda d: _without(d, "placements"),
    "unknown joint type 'ball'": lambda d: d["types"].__setitem__(0, "ball"),
    "parents has an index": lambda d: d["parents"].__setitem__(0, 0),
    "source has an index": lambda d: d["coupling"]["source"].__setitem__(2, 3),
    "placements: expected shape": lambda d: d["placements"].pop(),
    "unit length": lambda d: d["axes"].__setitem__(0, [0, 0, 2]),
    "there is no joint 7": lambda d: d["spheres"][0].__setitem__("joint", 7),
    "cannot be read": lambda d: d.__setitem__("spheres", [3]),
    "'name' is no text": lambda d: d.__setitem__("name", [d]),
    "too large": lambda d: d["parents"].__setitem__(0, -(10**30)),
    "parents: expected shape": lambda d: d.__setitem__("parents", [[-1]]),
}


@pytest.mark.parametrize("message", BROKEN)
def test_broken_data_are_refused(message):
    data = copy.deepcopy(Robot.builtin("planar3").to_dict())
    BROKEN[message](data)
    with pytest.raises(RobotError, match=message):
        Robot.from_dict(data)


def test_what_is_no_mapping_is_refused():
    with pytest.raises(RobotError, match="no mapping but a ndarray"):
        Robot.from_dict(np.zeros(3))
