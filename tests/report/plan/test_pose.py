import numpy as np
import pytest

from rrnn_opt.report.plan.pose import joint_frames, sphere_centres, tip_positions
from rrnn_opt.robot import Kinematics, Robot


@pytest.mark.parametrize("name", ["pa10", "panda", "raven2", "planar3"])
def test_poses_of_a_block_are_those_of_the_symbolic_kinematics(name):
    robot = Robot.builtin(name)
    kinematics, block = Kinematics(robot), robot.to_dict()
    functions = kinematics.functions()
    rng = np.random.default_rng(3)
    q = rng.uniform(robot.limits.lower, robot.limits.upper, (5, robot.nv))
    frames = joint_frames(block, q)
    tips, (centres, radii) = tip_positions(block, frames), sphere_centres(block, frames)
    for k, posture in enumerate(q):
        wanted = np.array(functions["position"](posture)).ravel()
        np.testing.assert_allclose(tips[k], wanted, atol=1e-12)
        spheres = np.array(functions["sphere_centres"](posture)).T
        np.testing.assert_allclose(centres[k], spheres, atol=1e-12)
    np.testing.assert_array_equal(radii, [s.radius for s in robot.spheres])


def test_a_prismatic_joint_moves_along_its_axis(planar):
    near, far = tip_positions(planar, joint_frames(planar, [[0, 0, 0], [0, 0, 0.15]]))
    np.testing.assert_allclose(near, [2.4, 0, 0], atol=1e-15)
    np.testing.assert_allclose(far, [2.55, 0, 0], atol=1e-15)


def test_coupled_joints_follow_their_source(planar):
    planar["coupling"] = {
        "source": [0, 0, 1],
        "multiplier": [1.0, -1.0, 2.0],
        "offset": [0.0, 0.0, 0.1],
    }
    (tip,) = tip_positions(planar, joint_frames(planar, [[np.pi / 2, 0.05]]))
    np.testing.assert_allclose(tip, [0.8 + 0.2 + 0.6, 1.0, 0.0], atol=1e-12)
