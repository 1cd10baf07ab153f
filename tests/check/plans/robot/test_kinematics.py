"""Oracle: pinocchio, with a model built joint by joint from the document."""

import numpy as np
import pinocchio as pin
import pytest

from rrnn_opt.check.plans.robot import kinematics
from rrnn_opt.check.plans.robot.block import read_model

TYPES = {
    "revolute": pin.JointModelRevoluteUnaligned,
    "continuous": pin.JointModelRevoluteUnaligned,
    "prismatic": pin.JointModelPrismaticUnaligned,
}


def pinocchio_model(robot):
    model, ids = pin.Model(), []
    for k, parent in enumerate(robot["parents"]):
        placement = np.array(robot["placements"][k])
        joint = TYPES[robot["types"][k]](np.array(robot["axes"][k], dtype=float))
        on = ids[parent] if parent >= 0 else 0
        place = pin.SE3(placement[:3, :3], placement[:3, 3])
        ids.append(model.addJoint(on, joint, place, f"joint{k}"))
    return model, ids


@pytest.fixture
def cases(robot):
    model = read_model(robot)
    q = np.random.default_rng(7).uniform(-2.5, 2.5, (40, model.nv))
    return robot, model, q


def test_frames_are_pinocchios(cases):
    robot, model, q = cases
    oracle, ids = pinocchio_model(robot)
    data = oracle.createData()
    joints = model.joint_values(q)
    frames = kinematics.forward(model, joints.T)
    centres = kinematics.sphere_centres(model, frames)
    for n in range(len(q)):
        pin.forwardKinematics(oracle, data, joints[n])
        for k, joint in enumerate(ids):
            placed = data.oMi[joint]
            np.testing.assert_allclose(
                frames.origins[k, :, n], placed.translation, atol=1e-12
            )
            np.testing.assert_allclose(
                frames.rotations[k, :, :, n], placed.rotation, atol=1e-12
            )
            axis = placed.rotation @ np.array(robot["axes"][k])
            np.testing.assert_allclose(frames.axes[k, :, n], axis, atol=1e-12)
        for i, s in enumerate(robot["spheres"]):
            point = np.array(s["center"], dtype=float)
            if s["joint"] >= 0:
                point = data.oMi[ids[s["joint"]]].act(point)
            np.testing.assert_allclose(centres[:, i, n], point, atol=1e-12)


def test_tip_pose_is_pinocchios(cases):
    robot, model, q = cases
    oracle, ids = pinocchio_model(robot)
    data, tip = oracle.createData(), robot["tip"]
    for n in range(5):
        pin.forwardKinematics(oracle, data, model.joint_values(q)[n])
        placement = np.array(tip["placement"])
        wanted = data.oMi[ids[tip["joint"]]].homogeneous @ placement
        rotation, position = kinematics.tip_pose(model, q[n])
        np.testing.assert_allclose(rotation, wanted[:3, :3], atol=1e-12)
        np.testing.assert_allclose(position, wanted[:3, 3], atol=1e-12)


def test_coupled_joints_follow_their_coordinate(tree):
    model = read_model(tree)
    values = model.joint_values(np.array([[0.1, 0.2, 0.3, 0.4]]))
    np.testing.assert_allclose(values, [[0.1, 0.2, 0.5, 0.0, 0.8]], atol=1e-15)


def test_a_sphere_is_moved_by_its_ancestors_only(tree):
    model = read_model(tree)
    expected = np.array(
        [
            [0, 0, 0, 0, 0],
            [1, 0, 0, 0, 0],
            [1, 1, 1, 0, 0],
            [1, 1, 1, 0, 0],
            [1, 0, 0, 1, 1],
        ]
    )
    np.testing.assert_array_equal(model.sphere_moved_by, expected.astype(bool))
