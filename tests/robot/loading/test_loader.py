import os
import sys

import casadi as ca
import numpy as np
import pinocchio as pin
import pytest

from rrnn_opt.errors import RobotError
from rrnn_opt.robot import Kinematics, Robot
from rrnn_opt.robot.builtin import BUILTIN

ARMS = [  # file, end-effector link, is it quick?
    ("panda_description/urdf/panda.urdf", "panda_hand_tcp", True),
    ("kinova_description/robots/kinova.urdf", "j2s6s200_end_effector", True),
    ("ur_description/urdf/ur5_robot.urdf", "tool0", True),
    ("panda_description/urdf/panda_collision.urdf", "panda_leftfinger", False),
    ("xarm_description/urdf/xarm7.urdf", "link_eef", False),
    ("ur_description/urdf/ur3_robot.urdf", "tool0", False),
    ("ur_description/urdf/ur10_robot.urdf", "tool0", False),
    ("ur_description/urdf/ur5_gripper.urdf", "tool0", False),
    ("ur_description/urdf/ur3_joint_limited_robot.urdf", "tool0", False),
    ("z1_description/urdf/z1.urdf", "gripperMover", False),
    ("baxter_description/urdf/baxter.urdf", "left_gripper", False),
    ("baxter_description/urdf/baxter.urdf", "right_gripper", False),
    ("so_arm_description/urdf/so100.urdf", "gripper", False),
    ("so_arm_description/urdf/so101.urdf", "gripper_frame_link", False),
    ("tiago_description/robots/tiago.urdf", "arm_tool_link", False),
    ("tiago_description/robots/tiago_dual.urdf", "arm_left_tool_link", False),
    ("tiago_pro_description/robots/tiago_pro.urdf", "arm_right_tool_link", False),
    (
        "tiago_pro_description/robots/tiago_pro.urdf",
        "gripper_left_fingertip_left_link",
        False,
    ),
    ("talos_data/robots/talos_left_arm.urdf", "gripper_left_base_link", False),
    ("talos_data/robots/talos_full_v2.urdf", "wrist_right_ft_tool_link", False),
    ("pr2_description/urdf/pr2.urdf", "l_gripper_tool_frame", False),
    ("pr2_description/urdf/pr2.urdf", "r_gripper_l_finger_tip_link", False),
    ("alex_description/urdf/alex_nub_hands.urdf", "LeftGripperYawLink", False),
    ("g1_description/urdf/g1_29dof_rev_1_0.urdf", "left_rubber_hand", False),
    ("romeo_description/urdf/romeo.urdf", "r_wrist", False),
    ("icub_description/robots/icub.urdf", "l_hand", False),
    ("b1_description/urdf/b1-z1.urdf", "gripperStator", False),
    (
        "anymal_b_simple_description/robots/anymal-kinova.urdf",
        "j2s6s200_end_effector",
        False,
    ),
]
CASES = [
    pytest.param(path, tip, marks=() if quick else pytest.mark.slow)
    for path, tip, quick in ARMS
]


@pytest.mark.parametrize(("path", "tip"), CASES)
def test_arms_of_the_wheel_agree_with_pinocchio(path, tip, robots_folder, oracle):
    robot = Robot.from_urdf(robots_folder / path, tip=tip)
    assert robot.tip == tip
    oracle.agrees(robot, robots_folder / path)


def test_continuous_joints_are_plain_angles(robots_folder):
    robot = Robot.from_urdf(
        robots_folder / "kinova_description/robots/kinova.urdf",
        tip="j2s6s200_end_effector",
    )
    assert robot.nv == 6
    assert robot.tree.types[0] == "continuous"
    assert robot.limits.upper[0] == np.inf
    assert robot.to_dict()["limits"]["upper"][0] is None
    assert robot.limits.velocity[0] == pytest.approx(0.628318530718)


@pytest.mark.parametrize("name", BUILTIN)
def test_a_built_in_written_as_urdf_comes_back(name, tmp_path, oracle):
    robot = Robot.builtin(name)
    path = tmp_path / "arm.urdf"
    path.write_text(oracle.urdf_text(robot))
    again = Robot.from_urdf(path, tip=f"frame_{robot.tip}")
    assert again.joint_names == robot.joint_names
    assert again.tree.types == robot.tree.types
    assert np.abs(again.tree.placements - robot.tree.placements).max() < 1e-15
    assert np.array_equal(again.limits.lower, robot.limits.lower)
    assert np.array_equal(again.limits.velocity, robot.limits.velocity)


def test_limits_that_the_file_lacks_are_stated(branched):
    robot = Robot.from_urdf(branched, tip="finger")
    assert robot.limits.velocity.tolist() == [1.0, 0.2, 1.0]
    assert robot.limits.acceleration.tolist() == [5.0, 1.0, 5.0]
    assert "velocity limit 1 rad/s (0.1 m/s) assumed for turn" in robot.source
    assert "5 rad/s2 (1 m/s2) assumed for turn, lift, grip" in robot.source


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"tip": "nowhere"}, "no frame 'nowhere'"),
        ({"tip": "camera"}, "no joint moves"),
        ({"tip": "base"}, "no joint moves"),
        ({"locked": {"elbow": 0.1}}, "no joint 'elbow' to lock"),
        ({"locked": {"turn": float("nan")}}, "finite"),
        ({"spheres": "missing.json"}, "not a readable sphere file"),
    ],
)
def test_arguments_that_do_not_fit_are_named(branched, arguments, message):
    with pytest.raises(RobotError, match=message):
        Robot.from_urdf(branched, **{"tip": "hand", **arguments})


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('upper="2"', 'upper="-2"', "'turn' has the empty range"),
        ('mimic joint="turn"', 'mimic joint="oppose"', "in a circle"),
        ('xyz="0.1 0 0.5"', 'xyz="nan 0 0.5"', "branched"),
        ('axis xyz="0 1 1"', 'axis xyz="0 0 0"', "branched"),
        ('lower="0" upper="0.3"', "", "empty range"),
    ],
)
def test_files_that_make_no_arm_are_refused(tmp_path, old, new, message, oracle):
    assert old in oracle.branched_text
    path = tmp_path / "branched.urdf"
    path.write_text(oracle.branched_text.replace(old, new))
    with pytest.raises(RobotError, match=message):
        Robot.from_urdf(path, tip="thumb")


def test_loading_is_silent_and_gives_standard_error_back(robots_folder, capfd):
    Robot.from_urdf(robots_folder / "panda_description/urdf/panda.urdf")
    os.write(2, b"still here")
    sys.stderr.flush()
    captured = capfd.readouterr()
    assert captured.out == ""
    assert captured.err == "still here"


def test_standard_error_comes_back_after_a_refusal(tmp_path, capfd, oracle):
    path = tmp_path / "bad.urdf"
    path.write_text('<robot name="x"><link name="a"/><link name="b"/></robot>')
    with pytest.raises(RobotError, match="several roots"):
        Robot.from_urdf(path)
    path.write_text(oracle.branched_text.replace('upper="2"', 'upper="two"'))
    with pytest.raises(RobotError, match="pinocchio refuses it"):
        Robot.from_urdf(path)
    os.write(2, b"still here")
    assert capfd.readouterr().err == "still here"


def test_a_pinocchio_model_becomes_its_whole_tree(branched, oracle):
    model = pin.buildModelFromUrdf(str(branched))
    attributes = set(dir(model))
    robot = Robot.from_pinocchio(model, tip="camera")
    assert set(dir(model)) == attributes
    assert robot.nv == model.nv == 5
    assert robot.tip == "camera"
    assert Robot.from_pinocchio(model).tip == robot.frames[-1].name
    kin = Kinematics(robot)
    q = oracle.postures(robot, 1)[0]
    values = oracle.values_by_name(robot, q)
    for frame in ("thumb", "camera"):
        pose = np.array(ca.Function("T", [kin.q], [kin.pose(frame)])(q))
        want, _ = oracle.pin_pose_jacobian(model, values, frame)
        assert np.abs(pose - want).max() <= 1e-12


def test_joints_of_other_kinds_are_refused(branched):
    model = pin.buildModelFromUrdf(str(branched), pin.JointModelFreeFlyer())
    with pytest.raises(RobotError, match="JointModelFreeFlyer"):
        Robot.from_pinocchio(model)
    with pytest.raises(RobotError, match="no frame 'nowhere'"):
        Robot.from_pinocchio(pin.buildModelFromUrdf(str(branched)), tip="nowhere")
