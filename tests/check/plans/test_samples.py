"""Verdicts on random motions, held against samples measured by coal."""

import coal
import numpy as np
import pytest

from rrnn_opt.check.plans.robot.block import read_model
from rrnn_opt.motion import Trajectory
from rrnn_opt.robot import Robot
from tests.check.plans.motions import centres_at, judge, swing


def random_scene(rng, n):
    kinds = []
    for k in range(n):
        place = rng.uniform(-0.8, 0.8, 3)
        place[2] += 0.4
        kind = ("box", "cylinder", "sphere", "capsule")[k % 4]
        entry = {"type": kind, "name": str(k), "position": place.tolist()}
        if kind == "box":
            entry["size"] = rng.uniform(0.02, 0.3, 3).tolist()
        else:
            entry |= {
                "radius": rng.uniform(0.02, 0.15),
                "length": rng.uniform(0.05, 0.3),
            }
        quat = rng.normal(size=4)
        entry["quat_xyzw"] = (quat / np.linalg.norm(quat)).tolist()
        kinds.append(entry)
    return kinds


def coal_obstacles(model, obstacles):
    from rrnn_opt.check.plans.solids.obstacle import read_obstacle

    shapes = []
    for entry in obstacles:
        if entry["type"] == "box":
            shape = coal.Box(*entry["size"])
        elif entry["type"] == "sphere":
            shape = coal.Sphere(entry["radius"])
        else:
            kind = {"cylinder": coal.Cylinder, "capsule": coal.Capsule}[entry["type"]]
            shape = kind(entry["radius"], entry["length"])
        o = read_obstacle(entry, "o")
        shapes.append((shape, coal.Transform3s(o.rotation, o.position)))
    return shapes


def least_distance(model, shapes, spheres):
    """Least distance of moving spheres to obstacles by coal, at one posture."""
    least = np.inf
    for i in np.flatnonzero(model.carrier >= 0):
        ball = coal.Sphere(model.radii[i])
        at = coal.Transform3s(np.eye(3), spheres[i])
        for shape, place in shapes:
            request, result = coal.DistanceRequest(), coal.DistanceResult()
            least = min(least, coal.distance(ball, at, shape, place, request, result))
    return least


@pytest.mark.parametrize("name", ["planar3", "pa10", "raven2"])
def test_no_sample_contradicts_a_verdict(name):
    """Random smooth motions among random obstacles; coal looks at 40 instants."""
    arm = Robot.builtin(name)
    robot, model = arm.to_dict(), read_model(arm.to_dict())
    model = read_model({**robot, "self_pairs": []})
    rng = np.random.default_rng(11)
    low, high = np.maximum(arm.limits.lower, -2), np.minimum(arm.limits.upper, 2)
    verdicts = []
    for _ in range(6):
        q = rng.uniform(low, high, (3, arm.nv))
        qd = rng.normal(size=(3, arm.nv)) * 0.3 * (high - low)
        qd[[0, -1]] = 0.0
        motion = Trajectory.from_rows([0.0, 1.0, 2.0], q, qd)
        scene = random_scene(rng, 2)
        found = judge({**robot, "self_pairs": []}, scene, motion)
        verdicts.append(found.collision_free)
        shapes = coal_obstacles(model, scene)
        times = np.linspace(0, 2, 40)
        if found.collision_free == "REFUTED":
            times = np.array([found.witness["time"]])
        all_centres = centres_at({**robot, "self_pairs": []}, motion, times)
        least = min(least_distance(model, shapes, c) for c in all_centres)
        if found.collision_free == "PROVED":
            assert least >= found.clearance_lower_bound - 2e-6
        else:
            assert least < 1e-6
    assert {"PROVED", "REFUTED"} >= set(verdicts)


def test_both_verdicts_occur_among_the_random_motions():
    """Guards the test above against a scene that decides nothing."""
    arm = Robot.builtin("planar3")
    robot, rng = {**arm.to_dict(), "self_pairs": []}, np.random.default_rng(5)
    seen = set()
    for _ in range(20):
        motion = swing(robot, rng.uniform(-2, 2, 3), rng.uniform(-2, 2, 3))
        ball = {"type": "sphere", "radius": 0.3, "position": [0.9, 0.9, 0.0]}
        seen.add(judge(robot, [ball], motion).collision_free)
    assert seen == {"PROVED", "REFUTED"}
