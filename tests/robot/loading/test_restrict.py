import casadi as ca
import numpy as np
import pinocchio as pin
import pytest

from rrnn_opt.errors import RobotError
from rrnn_opt.robot import Kinematics, Robot


@pytest.mark.parametrize("tip", ["hand", "finger", "thumb"])
@pytest.mark.parametrize("locked", [{}, {"grip": 0.4}, {"turn": -0.7}])
def test_mimic_and_locked_joints_agree_with_pinocchio(tip, locked, branched, oracle):
    robot = Robot.from_urdf(branched, tip=tip, locked=locked)
    assert not set(robot.joint_names) & {*locked, "oppose", "pan"}
    oracle.agrees(robot, branched, locked=locked)
    for frame in ("hand", "thumb", "camera", "base"):
        kin = Kinematics(robot)
        q = oracle.postures(robot, 1)[0]
        pose = np.array(ca.Function("T", [kin.q], [kin.pose(frame)])(q))
        values = oracle.pin_values(robot, q, oracle.mimic_couplings(branched), locked)
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


def test_the_default_tip_is_the_last_leaf_that_moves(branched):
    assert Robot.from_urdf(branched).tip == "thumb"


@pytest.mark.parametrize("locked", [{}, {"turn": 0.6}, {"oppose": 0.2}])
def test_a_joint_may_mimic_a_mimic_joint(locked, tmp_path, oracle):
    path = tmp_path / "twice.urdf"
    old, new = 'mimic joint="grip"', 'mimic joint="oppose"'
    assert old in oracle.branched_text
    path.write_text(oracle.branched_text.replace(old, new))
    robot = Robot.from_urdf(path, tip="hand", locked=locked)
    model, kin = pin.buildModelFromUrdf(str(path)), Kinematics(robot)
    camera = ca.Function("T", [kin.q], [kin.pose("camera")])
    for q in oracle.postures(robot, 3):
        values = oracle.pin_values(robot, q, oracle.mimic_couplings(path), locked)
        want, _ = oracle.pin_pose_jacobian(model, values, "camera")
        assert np.abs(np.array(camera(q)) - want).max() <= 1e-12


def test_several_tips_move_all_their_joints_each_once(branched, oracle):
    robot = Robot.from_urdf(branched, tips=["hand", "finger"])
    first = Robot.from_urdf(branched, tip="hand").joint_names
    more = Robot.from_urdf(branched, tip="finger").joint_names
    assert robot.joint_names == tuple(dict.fromkeys(first + more))
    assert len(robot.joint_names) > len(first)
    assert robot.tip == "hand"
    model, kin = pin.buildModelFromUrdf(str(branched)), Kinematics(robot)
    both = ca.Function("T", [kin.q], [kin.pose("finger"), kin.pose("camera")])
    for q in oracle.postures(robot, 3):
        values = oracle.pin_values(robot, q, oracle.mimic_couplings(branched), {})
        for pose, frame in zip(both(q), ("finger", "camera"), strict=True):
            want, _ = oracle.pin_pose_jacobian(model, values, frame)
            assert np.abs(np.array(pose) - want).max() <= 1e-12


@pytest.mark.parametrize("tips", ["hand", ["hand", "camera"]])
def test_one_tip_or_several_but_not_both(branched, tips):
    with pytest.raises(RobotError, match="either one 'tip' or a sequence of 'tips'"):
        Robot.from_urdf(branched, tip="hand" if len(tips) == 2 else None, tips=tips)
