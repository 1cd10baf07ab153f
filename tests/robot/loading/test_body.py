import json

import numpy as np
import pinocchio as pin
import pytest

from rrnn_opt.errors import RobotError
from rrnn_opt.robot import Robot


def test_a_panda_file_with_the_panda_spheres_is_the_built_in(robots_folder):
    from importlib import resources

    spheres = resources.files("rrnn_opt.robot.builtin") / "data/panda_spheres.json"
    fingers = ("panda_leftfinger", "panda_rightfinger")
    robot = Robot.from_urdf(
        robots_folder / "panda_description/urdf/panda.urdf",
        tip="panda_hand",
        spheres=spheres,
        locked={"panda_finger_joint1": 0.03},
    )
    ours = Robot.builtin("panda")
    assert set(robot.self_pairs) == set(ours.self_pairs)
    assert robot.limits.acceleration.tolist() == ours.limits.acceleration.tolist()
    same = [s for s in ours.spheres if s.link not in fingers]
    theirs = [s for s in robot.spheres if s.link not in fingers]
    for mine, other in zip(same, theirs, strict=True):
        assert (mine.link, mine.joint, mine.radius) == (
            other.link,
            other.joint,
            other.radius,
        )
        assert np.abs(mine.center - other.center).max() < 1e-9


def test_a_sphere_file_for_another_robot_is_refused(branched, tmp_path):
    path = tmp_path / "spheres.json"
    ball = {"center": [0, 0, 0], "radius": 0.1}
    path.write_text(json.dumps({"links": {"hand": [ball], "stranger": []}}))
    robot = Robot.from_urdf(branched, tip="finger", spheres=path)
    assert [s.link for s in robot.spheres] == ["hand"]
    assert robot.cover == {}
    path.write_text(json.dumps({"links": {"stranger": [ball]}}))
    with pytest.raises(RobotError, match="names 'stranger'"):
        Robot.from_urdf(branched, tip="finger", spheres=path)


def test_primitives_are_covered_and_meshes_named(branched):
    robot = Robot.from_urdf(branched, tip="finger")
    links = [sphere.link for sphere in robot.spheres]
    assert set(links) == {"base", "arm", "hand"}
    assert robot.cover["missing"] == ["finger"]
    assert robot.cover["inflation_m"][0] == 0.0
    assert robot.self_pairs == (("base", "hand"),)
    arm = [sphere for sphere in robot.spheres if sphere.link == "arm"]
    turn = pin.rpy.rpyToMatrix(0, 0.3, 0)
    for end in (-0.25, 0.25):
        for angle in np.linspace(0, 6, 20):
            rim = np.array([0.05 * np.cos(angle), 0.05 * np.sin(angle), end])
            point = turn @ rim + [0, 0, 0.25]
            gaps = [np.linalg.norm(point - s.center) - s.radius for s in arm]
            assert min(gaps) <= 0.0


def test_a_file_without_geometry_misses_every_link(tmp_path, oracle):
    path = tmp_path / "bare.urdf"
    path.write_text(oracle.urdf_text(Robot.builtin("planar3")))
    robot = Robot.from_urdf(path)
    assert robot.spheres == ()
    assert "body0" in robot.cover["missing"]
