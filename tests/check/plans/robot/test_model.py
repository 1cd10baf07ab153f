import copy

import numpy as np
import pytest

from rrnn_opt.check.plans.robot.block import read_model
from rrnn_opt.errors import DocumentError


def test_a_robot_is_read_as_written(tree):
    model = read_model(tree)
    assert (model.nj, model.nv) == (5, 4)
    np.testing.assert_array_equal(model.continuous, [False, False, False, True])
    np.testing.assert_array_equal(model.prismatic, [False, True, False, True, False])
    assert model.lower[3] == -np.inf
    assert model.upper[3] == np.inf
    expected = {(2, 4), (3, 4), (0, 2), (0, 3), (0, 4)}
    assert set(map(tuple, model.pairs.tolist())) == expected
    assert model.tip[:2] == ("hand", 2)


def test_every_robot_is_read(robot):
    model = read_model(robot)
    assert model.nj == len(robot["parents"])
    assert len(model.radii) == len(robot["spheres"])


@pytest.mark.parametrize(
    ("path", "value", "field"),
    [
        (("parents",), [-1, 0, 1, 4, 3], "parents"),
        (("parents",), [-1, 0, 1, 0.5, 3], "parents"),
        (("types", 0), "ball", "types"),
        (("placements", 1, 0, 0), 2.0, "placements"),
        (("placements", 1, 3), [0, 0, 0, 2], "placements"),
        (("axes", 0), [0, 0, 2], "axes"),
        (("coupling", "source"), [0, 1, 2, 1, 4], "source"),
        (("coupling", "multiplier"), [1, 1, 1, 1], "multiplier"),
        (("spheres", 0, "joint"), 5, "joint"),
        (("spheres", 0, "radius"), -0.1, "radius"),
        (("spheres", 0, "center"), [0, 0], "center"),
        (("self_pairs", 0), ["two"], "self_pairs"),
        (("self_pairs", 0), ["two", "tow"], "no sphere of the robot is of 'tow'"),
        (("limits", "velocity"), [1, 1, 1, 0], "velocity"),
        (("limits", "lower"), [None, None], "lower"),
        (("joint_names",), [], "joint_names"),
        (("tip",), None, "tip"),
        (("tip", "joint"), 9, "tip"),
    ],
)
def test_a_malformed_robot_is_refused_by_field(tree, path, value, field):
    broken = copy.deepcopy(tree)
    owner = broken
    for key in path[:-1]:
        owner = owner[key]
    owner[path[-1]] = value
    with pytest.raises(DocumentError, match=field):
        read_model(broken)
