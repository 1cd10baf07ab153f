import subprocess
import sys

import casadi as ca
import numpy as np
import pytest

from rrnn_opt.errors import RobotError
from rrnn_opt.robot import Kinematics, Robot
from rrnn_opt.robot.builtin import BUILTIN


def _position(robot, q, frame=None):
    kin = Kinematics(robot)
    return np.array(ca.Function("p", [kin.q], [kin.position(frame)])(q)).ravel()


@pytest.mark.parametrize("name", BUILTIN)
def test_every_built_in_states_itself(name):
    robot = Robot.builtin(name)
    limits = robot.limits
    assert robot.name == name
    assert robot.source
    assert robot.licence
    assert np.all(limits.lower < limits.upper)
    assert np.all(limits.velocity > 0)
    assert np.all(limits.acceleration > 0)
    links = {sphere.link for sphere in robot.spheres}
    assert links
    assert all(set(pair) <= links for pair in robot.self_pairs)
    for pose in robot.tree.placements:
        assert np.abs(pose[:3, :3].T @ pose[:3, :3] - np.eye(3)).max() < 1e-15


def test_an_unknown_robot_names_the_known_ones():
    with pytest.raises(RobotError, match="pa10, panda, raven2, planar3"):
        Robot.builtin("puma")


@pytest.mark.parametrize(
    ("degrees", "want"),
    [
        ((0, -45, 0, 90, 0, -45, 0), (0.0212, 0, 1.0446)),
        ((45, 30, 0, 60, 0, 45, 0), (0.5335, 0.5335, 0.6572)),
        ((0, 30, 0, 60, 0, 45, 0), (0.7545, 0, 0.6572)),
    ],
)
def test_pa10_reaches_the_published_points(degrees, want):
    robot = Robot.builtin("pa10")
    assert np.abs(_position(robot, np.radians(degrees)) - want).max() < 5.1e-5


def test_pa10_is_the_product_of_its_denavit_hartenberg_rows():
    robot = Robot.builtin("pa10")
    rises, twists = (0.317, 0, 0.45, 0, 0.48, 0, 0.07), (-90, 90, -90, 90, -90, 90, 0)
    q = np.random.default_rng(0).uniform(-3, 3, 7)
    pose = np.eye(4)
    for angle, d, twist in zip(q, rises, np.radians(twists), strict=True):
        c, s, ca_, sa = np.cos(angle), np.sin(angle), np.cos(twist), np.sin(twist)
        row = [[c, -s * ca_, s * sa, 0], [s, c * ca_, -c * sa, 0], [0, sa, ca_, d]]
        pose = pose @ np.array([*row, [0, 0, 0, 1]])
    kin = Kinematics(robot)
    tip = np.array(ca.Function("T", [kin.q], [kin.pose()])(q))
    assert np.abs(tip - pose).max() < 1e-14


def test_pa10_has_the_pinned_numbers():
    robot = Robot.builtin("pa10")
    degrees = np.degrees(robot.limits.upper)
    assert np.allclose(degrees, [177, 94, 174, 137, 255, 165, 360])
    assert np.array_equal(robot.limits.lower, -robot.limits.upper)
    assert np.allclose(robot.limits.velocity, [1, 1, 2, 2, *[2 * np.pi] * 3])
    assert np.array_equal(robot.limits.acceleration, [5.0] * 7)
    assert robot.tip == "flange"
    assert robot.cover["inflation_m"][1] <= 2e-3
    assert 40 <= len(robot.spheres) <= 48
    assert set(robot.tree.placements[:, :3, :3].ravel()) == {0.0, 1.0}
    column = [s for s in robot.spheres if s.link == "base_column"]
    assert {s.joint for s in column} == {0}


def test_panda_reaches_the_point_of_a_benchmark_goal():
    q = [1.48904932702624, -0.1466710603206631, -2.884974659739898]
    q += [-2.17455683759071, 2.709922823933047, 2.353209641613885, 1.06196398075046]
    want = [0.15137717419982485, -0.6583009860115431, 0.3507566200180861]
    assert np.abs(_position(Robot.builtin("panda"), q) - want).max() < 1e-11


def test_panda_has_the_pinned_numbers():
    robot = Robot.builtin("panda")
    assert len(robot.spheres) == 59
    assert len(robot.self_pairs) == 21
    assert ("panda_link0", "panda_link5") in robot.self_pairs
    disabled = {frozenset(("panda_link2", "panda_link4"))}
    disabled |= {frozenset(("panda_link7", "panda_hand"))}
    assert not disabled & {frozenset(pair) for pair in robot.self_pairs}
    assert set(np.abs(robot.tree.placements[:, :3, :3]).ravel()) == {0.0, 1.0}
    assert np.array_equal(robot.limits.velocity, [2.175] * 4 + [2.61] * 3)
    assert robot.limits.acceleration.tolist() == [15, 7.5, 10, 12.5, 15, 20, 20]
    assert robot.limits.lower[3] == -3.1416
    hand = _position(robot, np.zeros(7), "panda_hand")
    tip = _position(robot, np.zeros(7))
    assert np.linalg.norm(tip - hand) == pytest.approx(0.105, abs=1e-15)
    finger = next(s for s in robot.spheres if s.link == "panda_leftfinger")
    beyond = robot.frame("panda_hand").placement
    in_hand = np.linalg.inv(beyond) @ [*finger.center, 1.0]
    assert np.allclose(in_hand[:3], [0, 0.065 + 0.015, 0.0584 + 0.022])


def test_raven_reaches_the_published_point_and_depth():
    robot = Robot.builtin("raven2")
    q = [np.pi / 6, np.pi / 2, 0.40, 0, 0, 0]
    assert np.abs(_position(robot, q) - [-0.0779, -0.0253, 0.0132]).max() < 6e-5
    for insertion in (0.23, 0.40, 0.56):
        pitch = _position(robot, [0.3, 1.2, insertion, 0.5, 0.2, 0], "wrist_pitch")
        assert np.linalg.norm(pitch) == pytest.approx(abs(0.47 - insertion), abs=1e-15)
    assert np.linalg.norm(_position(robot, q)) == pytest.approx(0.07 + 0.013)


def test_planar_arm_has_the_pinned_numbers():
    robot = Robot.builtin("planar3")
    assert np.allclose(_position(robot, [0, 0, 0]), [2.4, 0, 0])
    assert np.allclose(_position(robot, [np.pi / 2, 0, 0]), [0, 2.4, 0])
    assert {sphere.radius for sphere in robot.spheres} == {0.05}
    assert robot.limits.upper.tolist() == [2.9] * 3
    assert robot.limits.velocity.tolist() == [2.0] * 3
    assert robot.limits.acceleration.tolist() == [10.0] * 3


LOADED = """
import sys, numpy
import rrnn_opt
rrnn_opt.Robot.builtin("pa10").to_dict()
assert not {"casadi", "pinocchio", "scipy"} & set(sys.modules)
"""


def test_a_built_in_loads_without_casadi_and_pinocchio():
    subprocess.run([sys.executable, "-W", "error", "-c", LOADED], check=True)
