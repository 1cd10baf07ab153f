"""What doubles proved must hold in balls; what is no proof must not."""

import dataclasses
import json

import numpy as np
import pytest

from rrnn_opt.check import certify_trajectory, check_plan
from rrnn_opt.check.plans.collision.look import Effort
from rrnn_opt.check.plans.collision.parts import Parts
from rrnn_opt.check.plans.collision.proof import prove_free
from rrnn_opt.check.plans.exact.cover import tiled
from rrnn_opt.check.plans.exact.recheck import recheck
from rrnn_opt.check.plans.exact.scene import BallScene
from rrnn_opt.check.plans.inputs import read_motion, read_scene
from rrnn_opt.check.plans.robot.block import read_model
from rrnn_opt.motion import Trajectory, stop_and_go
from rrnn_opt.robot import Robot

TURN = (np.array([1.0, 2.0, -3.0, 1.5]) / np.linalg.norm([1, 2, -3, 1.5])).tolist()
SOLIDS = [
    {"type": "box", "size": [0.2, 0.3, 0.1], "position": [2.5, 1, 0.2]},
    {"type": "cylinder", "radius": 0.1, "length": 0.3, "position": [1, 2.4, 0]},
    {"type": "capsule", "radius": 0.1, "length": 0.3, "position": [0, 0, 2.2]},
    {"type": "sphere", "radius": 0.2, "position": [2, -2.0, 0.2]},
    {"type": "halfspace", "normal": [0.6, 0.0, 0.8], "offset": -2.5},
]
for solid in SOLIDS[:3]:
    solid["quat_xyzw"] = TURN


class Speeds:
    lower, upper = np.full(7, -3.0), np.full(7, 3.0)
    velocity, acceleration = np.full(7, 2.0), np.full(7, 10.0)


def motion_for(model, seed, reach=0.5):
    rng = np.random.default_rng(seed)
    low, high = np.maximum(model.lower, -2), np.minimum(model.upper, 2)
    middle, half = (low + high) / 2, (high - low) / 2 * reach
    q = middle + half * rng.uniform(-1, 1, (3, model.nv))
    return stop_and_go(q, limits_of(model.nv)).to_dict()


def limits_of(nv):
    limits = Speeds()
    for name in ("lower", "upper", "velocity", "acceleration"):
        setattr(limits, name, getattr(Speeds, name)[:1].repeat(nv))
    return limits


def proof(robot, problem, rows):
    """A scene in balls, the doubles' verdict, and what they proved where."""
    model = read_model(robot)
    motion, _ = read_motion(rows, model.nv)
    scene = read_scene(Parts.of(model), problem, motion)
    effort = Effort(20_000, keep_leaves=True)
    found = prove_free(scene, motion, effort)
    return BallScene(robot, problem, scene, motion), found


def test_every_leaf_that_doubles_proved_is_proved_in_balls(robot):
    proved = 0
    for seed in range(4):
        rows = motion_for(read_model(robot), seed)
        balls, found = proof(robot, {"obstacles": SOLIDS, "margin": 0.01}, rows)
        leaves = found.leaves
        total = sum(len(leaf.box) for leaf in leaves)
        again = recheck(balls, leaves, every=max(1, total // 300))
        assert again.failed == 0
        assert again.rows > 0
        assert again.covered == (found.verdict == "PROVED")
        proved += found.verdict == "PROVED"
    if len(robot["spheres"]) < 10:
        assert proved > 0


def test_a_missing_time_or_pair_is_noticed(planar):
    rows = motion_for(read_model(planar), 1, reach=0.2)
    balls, found = proof(planar, {"obstacles": SOLIDS}, rows)
    assert recheck(balls, found.leaves).proved
    leaf = found.leaves[0]
    short = leaf._replace(box=leaf.box[1:], pair=leaf.pair[1:], shown=leaf.shown[1:])
    assert not recheck(balls, [short, *found.leaves[1:]]).covered
    half = dataclasses.replace(leaf.boxes, half=leaf.boxes.half / 2)
    hole = leaf._replace(boxes=half)
    assert not recheck(balls, [hole, *found.leaves[1:]]).covered


@pytest.mark.parametrize(
    ("ends", "whole"),
    [
        ([(0.0, 0.5), (0.5, 1.0)], True),
        ([(0.5, 1.0), (0.0, 0.25), (0.25, 0.5)], True),
        ([(0.0, 0.5), (0.5 + 2**-50, 1.0)], False),
        ([(0.0, 0.75), (0.5, 1.0)], False),
        ([(0.0, 0.5)], False),
        ([(2**-50, 1.0)], False),
        ([], False),
    ],
)
def test_boxes_must_touch_to_the_last_bit(ends, whole):
    rows = [np.array([[0], [0], [a], [b]]) for a, b in ends]
    assert tiled(rows, 1, 1) is whole


def test_a_bound_that_lies_is_refused(planar):
    """Leaves of a free scene do not pass for one where a solid is in the way."""
    rows = motion_for(read_model(planar), 1, reach=0.2)
    free = [{"type": "sphere", "radius": 0.1, "position": [1.0, 0.0, 2.0]}]
    near = [{"type": "sphere", "radius": 0.1, "position": [2.0, 0.0, 0.0]}]
    _, found = proof(planar, {"obstacles": free}, rows)
    balls, _ = proof(planar, {"obstacles": near}, rows)
    targets = balls.scene.targets
    swapped = []
    for leaf in found.leaves:
        is_self = leaf.target.required == 0.0 and not hasattr(leaf.target, "solids")
        target = targets[-1] if is_self else targets[0]
        if (leaf.target.finer is None) and target.finer is not None:
            target = target.finer.target
        swapped.append(leaf._replace(target=target))
    assert recheck(balls, swapped).failed > 0


def test_a_ball_that_does_not_hold_its_spheres_is_noticed():
    arm = Robot.builtin("panda").to_dict()
    rows = motion_for(read_model(arm), 3, reach=0.05)
    balls, _ = proof(arm, {"obstacles": SOLIDS}, rows)
    ball = int(balls.scene.targets[0].movers.spheres[3])
    assert recheck(balls, [], every=1).covered is False  # nothing proved at all
    from rrnn_opt.check.plans.exact.recheck import balls_hold

    assert balls_hold(balls)
    balls.body.radii[ball] = balls.body.radii[ball] * 0.99
    assert not balls_hold(balls)


@pytest.fixture
def plan(planar):
    rows = motion_for(read_model(planar), 1, reach=0.2)
    problem = {
        "start": rows["q"][0],
        "goal": {"joints": rows["q"][-1]},
        "obstacles": SOLIDS,
        "margin": 0.01,
    }
    found = certify_trajectory(planar, problem, rows)
    document = {
        "status": "solved",
        "trajectory": rows,
        "certificate": found.to_dict(),
        "problem": problem,
        "robot": planar,
    }
    return json.loads(json.dumps(document))


def test_a_plan_is_checked_exactly(plan):
    found = check_plan(plan, exact=True)
    assert found.holds
    assert "ball arithmetic" in found.certificate.method


def test_an_exact_check_that_fails_proves_nothing(plan, monkeypatch):
    from rrnn_opt.check.plans.exact import scene as ball_scene

    whole = ball_scene.BallScene.radii
    monkeypatch.setattr(ball_scene.BallScene, "radii", lambda *args: whole(*args) + 1.0)
    found = check_plan(plan, exact=True)
    assert found.certificate.collision_free == "UNKNOWN"
    assert found.certificate.clearance_lower_bound is None
    assert not found.holds


@pytest.mark.parametrize("huge", [1e7, 9e8])
def test_huge_numbers_prove_nothing(planar, huge):
    """Beyond the reduction of sine and cosine the answer is UNKNOWN, not a guess."""
    planar["limits"] |= {"lower": [None, None], "upper": [None, None]}
    q = np.array([[huge, 0.0], [huge, 0.1]])
    rows = Trajectory.from_rows([0.0, 1.0], q, np.zeros((2, 2))).to_dict()
    found = certify_trajectory(planar, {"obstacles": SOLIDS}, rows, max_boxes=200)
    assert found.collision_free == "UNKNOWN"
    assert found.clearance_lower_bound is None


def test_a_far_obstacle_does_not_blur_the_near_ones(planar):
    rows = motion_for(read_model(planar), 1, reach=0.2)
    far = {"type": "sphere", "radius": 1.0, "position": [9e8, 0.0, 0.0]}
    found = certify_trajectory(planar, {"obstacles": [*SOLIDS, far]}, rows)
    alone = certify_trajectory(planar, {"obstacles": SOLIDS}, rows)
    assert found.collision_free == "PROVED"
    assert found.clearance_lower_bound == alone.clearance_lower_bound
    assert found.rounding_bound_m > 1e-6 > alone.rounding_bound_m
