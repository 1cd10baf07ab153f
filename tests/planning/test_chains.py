"""Robots of 3 to 30 joints, prismatic ones among them, drawn at random."""

import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.planning import Problem
from rrnn_opt.planning.problem.goals import JointGoal
from rrnn_opt.robot.robot import Robot
from rrnn_opt.robot.tree import Frame, JointTree, Limits, Sphere
from rrnn_opt.scene import Scene
from rrnn_opt.scene import Sphere as Ball


def chain(joints, seed):
    """A chain of links 1 m in all, every fourth joint prismatic, axes at random."""
    step, end = 1.0 / joints, np.eye(4)
    end[:3, 3] = [step, 0.0, 0.0]
    tree = joint_tree(joints, seed)
    slides = np.array([t == "prismatic" for t in tree.types])
    return Robot(
        name=f"chain{joints}",
        joint_names=tuple(f"j{k}" for k in range(joints)),
        tree=tree,
        limits=Limits(
            np.where(slides, -0.05, -1.5),
            np.where(slides, 0.05, 1.5),
            np.ones(joints),
            5.0 * np.ones(joints),
        ),
        frames=(Frame("end", joints - 1, end),),
        tip="end",
        spheres=tuple(
            Sphere(f"link{k}", k, np.array([step / 2, 0.0, 0.0]), 0.02 + step / 2)
            for k in range(joints)
        ),
    )


def joint_tree(joints, seed):
    rng = np.random.default_rng([seed, joints])
    types = tuple("prismatic" if k % 4 == 2 else "revolute" for k in range(joints))
    placements = np.tile(np.eye(4), (joints, 1, 1))
    placements[1:, :3, 3] = [1.0 / joints, 0.0, 0.0]
    axes = rng.normal(size=(joints, 3))
    axes /= np.linalg.norm(axes, axis=1)[:, None]
    return JointTree(
        parents=np.arange(joints) - 1,
        types=types,
        placements=placements,
        axes=axes,
        source=np.arange(joints),
        multiplier=np.ones(joints),
        offset=np.zeros(joints),
    )


@pytest.mark.slow
@pytest.mark.parametrize("joints", [3, 5, 12, 30])
def test_chains_are_planned_and_proved(joints):
    robot = chain(joints, seed=1)
    rng = np.random.default_rng(joints)
    start = np.zeros(joints)
    goal = 0.7 * rng.uniform(robot.limits.lower, robot.limits.upper)
    position = rr.Kinematics(robot).functions()["position"]
    tips = [np.array(position(s * goal)).ravel() for s in (0.0, 0.5, 1.0)]
    ball = Ball("ball", 0.03, tips[1] + 0.09 * np.array([0.0, 0.6, 0.8]))
    problem = Problem(robot, start, goals=(JointGoal(goal),), scene=Scene((ball,)))
    result = rr.plan(problem, seed=3)
    assert result.status == "solved", result.message
    assert result.certificate["collision_free"] == "PROVED"
