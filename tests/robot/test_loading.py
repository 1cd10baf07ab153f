import json
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


def _all_values(robot, q, couplings, locked):
    """Value of every joint of the file, mimic joints resolved one by one."""
    values = {**locked, **dict(zip(robot.joint_names, q, strict=True))}
    for _ in couplings:
        for name, (source, multiplier, offset) in couplings.items():
            if name not in locked:
                values[name] = multiplier * values.get(source, 0.0) + offset
    return values


def _agrees(robot, path, oracle, *, locked=None, count=3):
    model = pin.buildModelFromUrdf(str(path))
    couplings = oracle.mimic_couplings(path)
    kin = Kinematics(robot)
    both = [kin.pose(), kin.jacobian(kind="pose")]
    evaluate = ca.Function("both", [kin.q], both)
    for q in oracle.postures(robot, count):
        values = _all_values(robot, q, couplings, locked or {})
        want, columns = oracle.pin_pose_jacobian(model, values, robot.tip)
        pose, jacobian = (np.array(value) for value in evaluate(q))
        assert np.abs(pose - want).max() <= 1e-12
        expected = np.stack([columns[name] for name in robot.joint_names], axis=1)
        for name, (source, multiplier, _) in couplings.items():
            if source in robot.joint_names and name not in robot.joint_names:
                i = robot.joint_names.index(source)
                expected[:, i] += multiplier * columns[name]
        assert np.abs(jacobian - expected).max() <= 1e-12


@pytest.mark.parametrize(("path", "tip"), CASES)
def test_arms_of_the_wheel_agree_with_pinocchio(path, tip, robots_folder, oracle):
    robot = Robot.from_urdf(robots_folder / path, tip=tip)
    assert robot.tip == tip
    _agrees(robot, robots_folder / path, oracle)


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


BRANCHED = """<robot name="branched">
<link name="base"><collision><geometry><box size="0.2 0.2 0.1"/></geometry></collision>
</link>
<link name="arm"><collision><origin xyz="0 0 0.25" rpy="0 0.3 0"/>
<geometry><cylinder radius="0.05" length="0.5"/></geometry></collision></link>
<link name="hand"><collision><geometry><sphere radius="0.06"/></geometry></collision>
</link>
<link name="finger"><collision><geometry><mesh filename="a.stl"/></geometry></collision>
</link>
<link name="thumb"/><link name="camera"/>
<joint name="turn" type="revolute"><parent link="base"/><child link="arm"/>
<origin xyz="0 0 0.1" rpy="0 0.2 0"/><axis xyz="0 1 1"/>
<limit lower="-2" upper="2" velocity="0" effort="1"/></joint>
<joint name="lift" type="prismatic"><parent link="arm"/><child link="hand"/>
<origin xyz="0.1 0 0.5" rpy="0.1 0 0"/><axis xyz="0 0 1"/>
<limit lower="0" upper="0.3" velocity="0.2" effort="1"/></joint>
<joint name="grip" type="revolute"><parent link="hand"/><child link="finger"/>
<origin xyz="0.02 0 0.1"/><axis xyz="1 0 0"/>
<limit lower="0" upper="1" velocity="1" effort="1"/></joint>
<joint name="oppose" type="revolute"><parent link="finger"/><child link="thumb"/>
<origin xyz="0 0 0.05"/><axis xyz="1 0 0"/>
<limit lower="-1" upper="1" velocity="1" effort="1"/>
<mimic joint="turn" multiplier="-0.5" offset="0.1"/></joint>
<joint name="pan" type="continuous"><parent link="base"/><child link="camera"/>
<origin xyz="0 0.1 0.2"/><axis xyz="0 0 1"/><limit velocity="20000" effort="1"/>
<mimic joint="grip" multiplier="2" offset="0.3"/></joint>
</robot>"""


@pytest.fixture
def branched(tmp_path):
    path = tmp_path / "branched.urdf"
    path.write_text(BRANCHED)
    return path


@pytest.mark.parametrize("tip", ["hand", "finger", "thumb"])
@pytest.mark.parametrize("locked", [{}, {"grip": 0.4}, {"turn": -0.7}])
def test_mimic_and_locked_joints_agree_with_pinocchio(tip, locked, branched, oracle):
    robot = Robot.from_urdf(branched, tip=tip, locked=locked)
    assert not set(robot.joint_names) & {*locked, "oppose", "pan"}
    _agrees(robot, branched, oracle, locked=locked)
    for frame in ("hand", "thumb", "camera", "base"):
        kin = Kinematics(robot)
        q = oracle.postures(robot, 1)[0]
        pose = np.array(ca.Function("T", [kin.q], [kin.pose(frame)])(q))
        values = _all_values(robot, q, oracle.mimic_couplings(branched), locked)
        model = pin.buildModelFromUrdf(str(branched))
        want, _ = oracle.pin_pose_jacobian(model, values, frame)
        assert np.abs(pose - want).max() <= 1e-12


def test_a_mimic_joint_beside_the_chain_follows(branched):
    robot = Robot.from_urdf(branched, tip="hand")
    assert robot.joint_names == ("turn", "lift")
    assert robot.tree.nj == 3
    assert robot.tree.source.tolist() == [0, 1, 0]
    assert robot.tree.multiplier.tolist() == [1, 1, -0.5]
    assert robot.frame("finger").joint == 1
    assert robot.frame("thumb").joint == 2
    assert robot.frame("camera").joint == -1


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


def test_limits_that_the_file_lacks_are_stated(branched):
    robot = Robot.from_urdf(branched, tip="finger")
    assert robot.limits.velocity.tolist() == [1.0, 0.2, 1.0]
    assert robot.limits.acceleration.tolist() == [5.0, 1.0, 5.0]
    assert "velocity limit 1 rad/s (0.1 m/s) assumed for turn" in robot.source
    assert "5 rad/s2 (1 m/s2) assumed for turn, lift, grip" in robot.source


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


def test_the_default_tip_is_the_last_leaf_that_moves(branched):
    assert Robot.from_urdf(branched).tip == "thumb"


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
def test_files_that_make_no_arm_are_refused(tmp_path, old, new, message):
    assert old in BRANCHED
    path = tmp_path / "branched.urdf"
    path.write_text(BRANCHED.replace(old, new))
    with pytest.raises(RobotError, match=message):
        Robot.from_urdf(path, tip="thumb")


def test_loading_is_silent_and_gives_standard_error_back(robots_folder, capfd):
    Robot.from_urdf(robots_folder / "panda_description/urdf/panda.urdf")
    os.write(2, b"still here")
    sys.stderr.flush()
    captured = capfd.readouterr()
    assert captured.out == ""
    assert captured.err == "still here"


def test_standard_error_comes_back_after_a_refusal(tmp_path, capfd):
    path = tmp_path / "bad.urdf"
    path.write_text('<robot name="x"><link name="a"/><link name="b"/></robot>')
    with pytest.raises(RobotError, match="several roots"):
        Robot.from_urdf(path)
    path.write_text(BRANCHED.replace('type="revolute"', 'type="revolute" bad=""', 1))
    path.write_text(BRANCHED.replace('upper="2"', 'upper="two"'))
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
