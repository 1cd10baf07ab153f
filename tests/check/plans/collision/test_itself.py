"""Spheres against one another, beside coal's distances and two arms drawn by hand."""

import numpy as np
import pytest

from rrnn_opt.check.plans import inputs
from rrnn_opt.check.plans.collision.boxes import Boxes, poses
from rrnn_opt.check.plans.collision.parts import Parts
from rrnn_opt.check.plans.motion import Motion
from rrnn_opt.check.plans.robot.block import read_model
from tests.check.conftest import pose, sphere

REACH, RADIUS, APART = 0.5, 0.05, 0.3
"""Length of both arms; size of both spheres; between their axes, m."""


def looked_at(robot, q, qd):
    """The finest self target, and the robot at the piece's middle."""
    model = read_model(robot)
    motion = Motion.of(np.array([0.0, 1.0]), np.asarray(q), np.asarray(qd))
    scene = inputs.read_scene(Parts.of(model), {"obstacles": []}, motion)
    target = scene.targets[-1]
    while target.finer is not None:
        target = target.finer.target
    now = poses(scene.model, scene.joint, Boxes.whole(0, 1), scene.errors)
    return (
        target,
        now,
        (np.zeros(target.count, dtype=np.int64), np.arange(target.count)),
    )


def test_distances_are_those_of_coal_for_every_listed_pair(robot):
    coal = pytest.importorskip("coal", reason="it comes with pin")
    q = np.random.default_rng(5).uniform(-0.2, 0.2, len(robot["joint_names"]))
    target, now, (box, pair) = looked_at(robot, [q, q], [0 * q, 0 * q])
    found, links = target.distance(now, box, pair), now.model.links
    np.testing.assert_array_equal(target.floor(now, box, pair, found), found)
    first, second = target.spheres
    for k in pair:
        i, j = first[k], second[k]
        assert target.label(k) == [links[i], links[j]]
        shapes = [coal.Sphere(float(now.model.radii[s])) for s in (i, j)]
        places = [
            coal.Transform3s(np.eye(3), now.centres[:, s, 0].copy()) for s in (i, j)
        ]
        far = coal.distance(
            shapes[0], places[0], shapes[1], places[1],
            coal.DistanceRequest(), coal.DistanceResult(),
        )  # fmt: skip
        assert found[k] == pytest.approx(far, abs=1e-6)
    listed = {frozenset(p) for p in robot["self_pairs"]}
    assert {frozenset(target.label(k)) for k in pair} <= listed
    assert target.count or not listed


def two_arms():
    """Two arms that reach along y, turning about z at x = 0 and x = APART."""
    return {
        "name": "twins", "parents": [-1, -1], "axes": [[0, 0, 1], [0, 0, 1]],
        "placements": [pose(), pose((APART, 0.0, 0.0))],
        "types": ["revolute", "revolute"], "joint_names": ["a", "b"],
        "coupling": {"source": [0, 1], "multiplier": [1.0, 1.0], "offset": [0.0, 0.0]},
        "tip": {"name": "tip", "joint": 0, "placement": pose()},
        "spheres": [
            sphere("left", 0, (0.0, REACH, 0.0), RADIUS),
            sphere("right", 1, (0.0, REACH, 0.0), RADIUS),
        ],
        "self_pairs": [["left", "right"]],
        "limits": {
            "lower": [-3.0] * 2, "upper": [3.0] * 2,
            "velocity": [2.0] * 2, "acceleration": [9.0] * 2,
        },
    }  # fmt: skip


@pytest.mark.parametrize("turns", [(0.1, 0.1), (-0.1, 0.1), (0.1, -0.1), (0.0, 0.2)])
def test_the_sharp_bound_is_the_tangent_and_half_of_both_bends(turns):
    """Gap - REACH |h_1 - h_2| - REACH (h_1^2 + h_2^2) / 2; the arcs stay above it."""
    h = np.array(turns)
    target, now, at = looked_at(two_arms(), [-h, h], [2 * h, 2 * h])
    gap, room = APART - 2 * RADIUS, np.abs(h).sum() * REACH
    assert target.distance(now, *at) == pytest.approx(gap, abs=1e-12)
    (sharp,) = target.sharp(now, *at)
    tangent, bends = REACH * abs(h[0] - h[1]), REACH * (h @ h)
    assert sharp == pytest.approx(gap - tangent - bends / 2, abs=1e-12)
    share = np.linspace(-1, 1, 201)[:, None] * h
    x, y = REACH * -np.sin(share) + [0.0, APART], REACH * np.cos(share)
    least = np.hypot(*(np.diff(c, axis=1) for c in (x, y))).min() - 2 * RADIUS
    assert sharp <= least + 1e-12
    assert target.travel(now, *at) == pytest.approx(room, abs=1e-12)
    look = target.first(now)
    assert look.d.item() == pytest.approx(gap, abs=1e-12)
    assert look.shown.item() == pytest.approx(gap - room, abs=1e-12)
    assert target.room(at[1]) == target.slack


def test_centres_that_coincide_are_a_collision_and_no_division_by_zero():
    robot = two_arms()
    robot["placements"][1] = pose()
    target, now, at = looked_at(robot, np.zeros((2, 2)), np.zeros((2, 2)))
    assert target.distance(now, *at) == pytest.approx(-2 * RADIUS, abs=1e-12)
    assert target.sharp(now, *at) == pytest.approx(-2 * RADIUS, abs=1e-12)
