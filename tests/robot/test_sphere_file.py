import json

import numpy as np
import pytest

from rrnn_opt.errors import RobotError
from rrnn_opt.robot import Frame, Sphere
from rrnn_opt.robot.sphere_file import checked_pairs, placed_spheres, read_sphere_file

BALL = {"center": [0.1, 0, 0], "radius": 0.05}


def _write(folder, data):
    path = folder / "spheres.json"
    path.write_text(data if isinstance(data, str) else json.dumps(data))
    return path


def test_what_a_file_says_is_read(tmp_path):
    data = {
        "links": {"a": [BALL], "b": []},
        "disabled_self_collision_pairs": [["b", "a", "Never"]],
    }
    file = read_sphere_file(_write(tmp_path, data))
    ((center, radius),) = file.links["a"]
    assert center.tolist() == [0.1, 0, 0]
    assert radius == 0.05
    assert file.links["b"] == ()
    assert file.disabled == {frozenset("ab")}
    silent = read_sphere_file(_write(tmp_path, {"links": {"a": [BALL]}}))
    assert silent.disabled is None


@pytest.mark.parametrize(
    "data",
    [
        "{",
        [],
        {"spheres": {}},
        {"links": {"a": [{"center": [0, 0], "radius": 1}]}},
        {"links": {"a": [{"center": [0, 0, 0], "radius": 0}]}},
        {"links": {"a": [{"center": [0, 0, float("nan")], "radius": 1}]}},
        {"links": {"a": [{"center": [0, 0, 0]}]}},
        {"links": {"a": 3}},
        {"links": {}, "disabled_self_collision_pairs": [["a"]]},
    ],
)
def test_a_file_that_makes_no_sense_is_refused(tmp_path, data):
    with pytest.raises(RobotError, match="sphere file"):
        read_sphere_file(_write(tmp_path, data))


def test_spheres_move_with_the_joint_that_carries_their_link():
    pose = np.eye(4)
    pose[:3, :3] = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
    pose[:3, 3] = 1, 2, 3
    (sphere,) = placed_spheres(
        {"a": [(np.array([0.1, 0, 0]), 0.05)]}, {"a": Frame("a", 4, pose)}
    )
    assert (sphere.link, sphere.joint, sphere.radius) == ("a", 4, 0.05)
    assert np.allclose(sphere.center, [1, 2.1, 3])


def test_links_on_one_joint_never_pair():
    joints = {"a": 0, "b": 0, "c": 1, "d": 2}
    spheres = [Sphere(link, joint, np.zeros(3), 1.0) for link, joint in joints.items()]
    pairs = checked_pairs(spheres, frozenset({frozenset("cd")}))
    assert pairs == (("a", "c"), ("a", "d"), ("b", "c"), ("b", "d"))


def test_more_spheres_than_anyone_fits_are_refused(tmp_path):
    ball = {"center": [0.0, 0.0, 0.0], "radius": 0.1}
    path = tmp_path / "s.json"
    path.write_text(json.dumps({"links": {"a": [ball] * 5001}}))
    with pytest.raises(RobotError, match="at most 5000"):
        read_sphere_file(path)
