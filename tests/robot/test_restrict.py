import casadi as ca
import numpy as np
import pinocchio as pin
import pytest

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
