from itertools import pairwise

import casadi as ca
import numpy as np
import pytest

from rrnn_opt.errors import RobotError
from rrnn_opt.robot import Frame, JointTree, Kinematics, Limits, Robot, Sphere
from rrnn_opt.robot.builtin import BUILTIN
from rrnn_opt.robot.reach import (
    ancestor_mask,
    joint_range,
    reach,
    reach_ball,
    tip_reach,
)

ROUNDING = 1e-14  # m, of the postures' own forward kinematics


def _levers(robot, postures):
    """Distance of every centre to every joint axis, (postures, nj, ns)."""
    kin = Kinematics(robot)
    parts = [kin.origins(), kin.axes(), kin.sphere_centres()]
    evaluate = ca.Function("parts", [kin.q], parts)
    out = []
    for q in postures:
        origins, axes, centres = (np.array(part) for part in evaluate(q))
        arms = centres[:, None, :] - origins[:, :, None]
        out.append(
            np.linalg.norm(np.cross(axes.T[:, None], arms.transpose(1, 2, 0)), axis=2)
        )
    return np.array(out)


def _random_robot(seed):
    """A coupled tree of revolute and prismatic joints with spheres everywhere."""
    rng = np.random.default_rng(seed)
    nj = 6
    quats = rng.normal(size=(nj, 4))
    poses = np.tile(np.eye(4), (nj, 1, 1))
    for pose, quat in zip(poses, quats, strict=True):
        w, v = quat[0] / np.linalg.norm(quat), quat[1:] / np.linalg.norm(quat)
        skew = np.cross(np.eye(3), v)
        pose[:3, :3] = np.eye(3) + 2 * w * skew + 2 * skew @ skew
        pose[:3, 3] = rng.uniform(-0.5, 0.5, 3) * rng.integers(0, 2)
    axes = rng.normal(size=(nj, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    tree = JointTree(
        parents=np.array([-1, 0, 1, 2, 2, 4]),
        types=tuple(rng.choice(["revolute", "prismatic"], nj)),
        placements=poses,
        axes=axes,
        source=np.array([0, 1, 2, 3, 4, 1]),
        multiplier=np.array([1, 1, 1, 1, 1, -0.7]),
        offset=np.array([0, 0, 0, 0, 0, 0.2]),
    )
    box = Limits(rng.uniform(-1, 0, 5), rng.uniform(0.1, 1, 5), np.ones(5), np.ones(5))
    spheres = tuple(
        Sphere(f"l{k}", k, rng.uniform(-0.3, 0.3, 3), 0.05) for k in range(-1, nj)
    )
    frame = Frame("tip", nj - 1, poses[0])
    names = tuple(f"j{k}" for k in range(5))
    return Robot("random", names, tree, box, (frame,), "tip", spheres)


@pytest.mark.parametrize("name", BUILTIN)
def test_no_posture_exceeds_the_reach_of_a_built_in(name, oracle):
    robot = Robot.builtin(name)
    bounds, mask = reach(robot), ancestor_mask(robot)
    levers = _levers(robot, oracle.postures(robot, 300))
    revolute = np.array([kind != "prismatic" for kind in robot.tree.types])
    checked = mask & revolute[:, None]
    assert np.all(levers.max(axis=0)[checked] <= bounds[checked] + ROUNDING)
    assert np.all(bounds[~mask] == 0.0)
    assert np.all(bounds[~revolute] == 1.0 * mask[~revolute])


@pytest.mark.parametrize("seed", range(20))
def test_no_motion_of_a_random_tree_exceeds_its_bound(seed, oracle):
    robot = _random_robot(seed)
    kin, bounds, tree = Kinematics(robot), reach(robot), robot.tree
    centres = ca.Function("c", [kin.q], [kin.sphere_centres()])
    ends = oracle.postures(robot, 60, seed)
    for first, second in pairwise(ends):
        way = np.linalg.norm(
            np.array(centres(second)) - np.array(centres(first)), axis=0
        )
        steps = np.abs(tree.multiplier * (second - first)[tree.source])
        assert np.all(way <= bounds.T @ steps + 1e-12)
    levers = _levers(robot, ends).max(axis=0)
    revolute = np.array([kind == "revolute" for kind in tree.types])
    checked = ancestor_mask(robot) & revolute[:, None]
    assert np.all(levers[checked] <= bounds[checked] + ROUNDING)


def test_reach_is_attained_where_the_arm_can_stretch():
    robot = Robot.builtin("pa10")
    stretched = np.array([0, np.pi / 2, 0, 0, 0, 0, 0])
    levers = _levers(robot, [stretched])[0]
    levers = levers * ancestor_mask(robot)
    assert np.allclose(reach(robot)[:2], levers[:2], rtol=1e-12, atol=1e-12)
    planar = Robot.builtin("planar3")
    straight = _levers(planar, [np.zeros(3)])[0] * ancestor_mask(planar)
    assert np.allclose(reach(planar), straight, rtol=1e-12)


def test_reach_of_the_panda_is_near_what_postures_attain(oracle):
    robot = Robot.builtin("panda")
    levers = _levers(robot, oracle.postures(robot, 4000)).max(axis=0)
    mask = ancestor_mask(robot)
    ratio = levers[mask] / np.maximum(reach(robot)[mask], 1e-12)
    assert np.median(ratio) > 0.93


def test_reach_of_the_raven_takes_insertion_and_shaft_together():
    robot = Robot.builtin("raven2")
    wrist = [i for i, s in enumerate(robot.spheres) if s.link == "wrist"]
    assert reach(robot)[0, wrist].max() <= 0.24 + 0.013 + 1e-9


@pytest.mark.parametrize("name", BUILTIN)
def test_tip_stays_within_its_reach(name, oracle):
    robot = Robot.builtin(name)
    kin = Kinematics(robot)
    centre, radius = reach_ball(robot)
    position = ca.Function("p", [kin.q], [kin.position()])
    points = [np.array(position(q)).ravel() for q in oracle.postures(robot, 500)]
    away = np.linalg.norm(np.array(points) - centre, axis=1)
    start = robot.tree.placements[0][:3, 3]
    from_start = np.linalg.norm(np.array(points) - start, axis=1)
    assert away.max() <= radius
    assert from_start.max() <= tip_reach(robot)
    assert away.max() > 0.85 * radius


def test_tip_reach_of_the_pa10_is_its_stretched_length():
    robot = Robot.builtin("pa10")
    centre, radius = reach_ball(robot)
    assert centre.tolist() == [0, 0, 0.317]
    assert radius == pytest.approx(1.0, abs=1e-12)
    assert tip_reach(robot) == pytest.approx(1.317, abs=1e-12)
    assert tip_reach(robot, "base") == 0.0


@pytest.mark.parametrize("seed", range(20))
def test_tip_of_a_random_tree_stays_within_its_reach(seed, oracle):
    robot = _random_robot(seed)
    kin = Kinematics(robot)
    centre, radius = reach_ball(robot)
    position = ca.Function("p", [kin.q], [kin.position()])
    start = robot.tree.placements[0][:3, 3]
    for q in oracle.postures(robot, 100, seed):
        point = np.array(position(q)).ravel()
        assert np.linalg.norm(point - centre) <= radius
        assert np.linalg.norm(point - start) <= tip_reach(robot)


def test_an_unlimited_prismatic_joint_has_no_reach():
    robot = _random_robot(0)
    types = ("revolute", "prismatic", *robot.tree.types[2:])
    tree = JointTree(**{**vars(robot.tree), "types": types})
    open_box = Limits(np.full(5, -np.inf), np.full(5, np.inf), np.ones(5), np.ones(5))
    unlimited = Robot(**{**vars(robot), "tree": tree, "limits": open_box})
    with pytest.raises(RobotError, match="prismatic joint 1 is unlimited"):
        reach(unlimited)


def test_range_of_a_coupled_joint_is_ordered():
    robot = _random_robot(3)
    low, high = joint_range(robot, 5)
    assert low == pytest.approx(-0.7 * robot.limits.upper[1] + 0.2)
    assert high == pytest.approx(-0.7 * robot.limits.lower[1] + 0.2)
