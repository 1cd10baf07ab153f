"""Spheres against obstacles, beside coal's distances and one arc drawn by hand."""

from itertools import product

import numpy as np
import pytest

from rrnn_opt.check.plans import inputs
from rrnn_opt.check.plans.collision.boxes import Boxes, poses
from rrnn_opt.check.plans.collision.parts import Parts
from rrnn_opt.check.plans.motion import Motion
from rrnn_opt.check.plans.robot.block import read_model
from tests.check.conftest import pose, sphere

OBSTACLES = [
    {"type": "box", "name": "near", "size": [0.4, 0.6, 0.2], "position": [3, 1, 1]},
    {"type": "box", "name": "far", "size": [0.1, 0.2, 0.9], "position": [-2, 2, 0]},
    {"type": "sphere", "name": "ball", "radius": 0.2, "position": [1.5, -2.5, 1.0]},
]
TURN, REACH, RADIUS, GAP = 0.1, 0.8, 0.05, 0.3
"""Half an arc's angle, rad; the sphere's way from the axis, its size, its gap, m."""


def looked_at(robot, obstacles, q, qd):
    """The finest target of the first kind, and the robot at the piece's middle."""
    model = read_model(robot)
    motion = Motion.of(np.array([0.0, 1.0]), np.asarray(q), np.asarray(qd))
    problem = {"obstacles": obstacles}
    scene = inputs.read_scene(Parts.of(model), problem, motion)
    now = poses(scene.model, scene.joint, Boxes.whole(0, 1), scene.errors)
    return [t.finer.target for t in scene.targets[:-1]], now


def every(target):
    return np.zeros(target.count, dtype=np.int64), np.arange(target.count)


def by_coal(radius, centre, entry):
    """Distance of a sphere to a solid that is not turned."""
    coal = pytest.importorskip("coal", reason="it comes with pin")
    box = entry["type"] == "box"
    solid = coal.Box(*entry["size"]) if box else coal.Sphere(entry["radius"])
    at, there = (
        coal.Transform3s(np.eye(3), np.asarray(p, dtype=float))
        for p in (centre, entry["position"])
    )
    asked, found = coal.DistanceRequest(), coal.DistanceResult()
    return coal.distance(coal.Sphere(radius), at, solid, there, asked, found)


def test_distances_are_those_of_coal_for_every_sphere_and_obstacle(robot):
    q = np.random.default_rng(4).uniform(-0.2, 0.2, len(robot["joint_names"]))
    targets, now = looked_at(robot, OBSTACLES, [q, q], [0 * q, 0 * q])
    assert [t.members for t in targets] == [(0, 1), (2,)]
    carrier = now.model.carrier[: len(robot["spheres"])]
    for target in targets:
        box, pair = every(target)
        found, (spheres,) = target.distance(now, box, pair), target.spheres
        np.testing.assert_array_equal(target.floor(now, box, pair, found), found)
        entries = {OBSTACLES[k]["name"]: OBSTACLES[k] for k in target.members}
        pairs = [(spheres[k], target.label(k)[1]) for k in pair]
        assert sorted(pairs) == sorted(product(np.flatnonzero(carrier >= 0), entries))
        for k, (i, name) in enumerate(pairs):
            assert target.label(k)[0] == now.model.links[i]
            centre = now.centres[:, i, 0]
            far = by_coal(float(now.model.radii[i]), centre, entries[name])
            assert found[k] == pytest.approx(far, abs=1e-6)


def arc(normal, qd):
    """One turning sphere, and a wall before it, square to ``normal``."""
    robot = {
        "name": "arm", "parents": [-1], "placements": [pose()], "axes": [[0, 0, 1]],
        "types": ["revolute"], "joint_names": ["a"], "self_pairs": [],
        "coupling": {"source": [0], "multiplier": [1.0], "offset": [0.0]},
        "tip": {"name": "tip", "joint": 0, "placement": pose()},
        "spheres": [sphere("arm", 0, (REACH, 0.0, 0.0), RADIUS)],
        "limits": {
            "lower": [-3.0], "upper": [3.0], "velocity": [2.0], "acceleration": [9.0]
        },
    }  # fmt: skip
    level = np.dot(normal, [REACH, 0, 0]) - RADIUS - GAP
    wall = {"type": "halfspace", "normal": normal, "offset": level}
    (target,), now = looked_at(robot, [wall], [[-TURN], [TURN]], [[qd], [qd]])
    return target, now


@pytest.mark.parametrize(
    ("normal", "first"),
    [([1.0, 0.0, 0.0], 0.0), ([-1.0, 0.0, 0.0], 0.0), ([0.0, 1.0, 0.0], REACH * TURN)],
)
def test_the_sharp_bound_is_the_tangent_and_half_of_the_bend(normal, first):
    """h = TURN: gap - |n'J h| - R h^2 / 2, and the arc itself stays above it."""
    target, now = arc(normal, 2 * TURN)
    box, pair = every(target)
    assert target.distance(now, box, pair) == pytest.approx(GAP, abs=1e-12)
    (sharp,) = target.sharp(now, box, pair)
    assert sharp == pytest.approx(GAP - first - REACH * TURN**2 / 2, abs=1e-12)
    angles = np.linspace(-TURN, TURN, 101)
    circle = REACH * np.array([np.cos(angles), np.sin(angles), 0 * angles])
    least = (normal @ circle).min() - normal @ np.array([REACH, 0, 0]) + GAP
    assert sharp <= least
    (way,) = target.travel(now, box, pair)
    assert way == pytest.approx(REACH * TURN, abs=1e-12)
    look = target.first(now)
    assert look.d.item() == pytest.approx(GAP, abs=1e-12)
    assert look.shown.item() == pytest.approx(GAP - way, abs=1e-12)


def test_the_room_of_a_pair_is_that_of_its_obstacle(tree):
    """A larger obstacle rounds more and gets more slack; pairs are solid by solid."""
    small = {"type": "sphere", "radius": 0.1, "position": [3.0, 0.0, 0.0]}
    large = {"type": "sphere", "radius": 90.0, "position": [-99.0, 0.0, 0.0]}
    (target,), _ = looked_at(tree, [small, large], np.zeros((2, 4)), np.zeros((2, 4)))
    room, own = target.room(np.arange(target.count)), target.count // 2
    assert 0 < room[0] < room[-1]
    np.testing.assert_array_equal(room, np.repeat(room[[0, -1]], own))
