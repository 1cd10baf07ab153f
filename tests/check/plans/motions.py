"""Motions and obstacles that the tests of verdicts share."""

import numpy as np

from rrnn_opt.check import certify_trajectory
from rrnn_opt.check.plans.robot import kinematics
from rrnn_opt.check.plans.robot.block import read_model
from rrnn_opt.motion import stop_and_go


class Speeds:
    """Limits wide enough for any test motion."""

    def __init__(self, nv, velocity=2.0, acceleration=10.0):
        self.lower, self.upper = np.full(nv, -9.0), np.full(nv, 9.0)
        self.velocity = np.full(nv, velocity)
        self.acceleration = np.full(nv, acceleration)


def swing(robot, *postures):
    """At rest in each posture, straight lines between them."""
    return stop_and_go(np.array(postures, dtype=float), Speeds(len(postures[0])))


def box(position, size, name="wall"):
    return {"type": "box", "name": name, "position": list(position), "size": list(size)}


def judge(robot, obstacles, trajectory, **more):
    problem = {"obstacles": obstacles, **more}
    return certify_trajectory(robot, problem, trajectory.to_dict())


def centres_at(robot, trajectory, times):
    """Sphere centres at each time, (N, ns, 3)."""
    model = read_model(robot)
    joints = model.joint_values(trajectory.at(times)[0]).T
    found = kinematics.sphere_centres(model, kinematics.forward(model, joints))
    return np.moveaxis(found, (0, 1, 2), (2, 1, 0))
