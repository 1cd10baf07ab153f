"""The derived bounds against what rounding really did, measured by balls."""

import flint
import numpy as np
import pytest

from rrnn_opt.check.arithmetic.doubles import U
from rrnn_opt.check.plans import inputs
from rrnn_opt.check.plans.collision.boxes import Boxes, poses
from rrnn_opt.check.plans.collision.parts import Parts
from rrnn_opt.check.plans.exact.robot import PRECISION, length, nearest_rotation
from rrnn_opt.check.plans.exact.scene import BallScene
from rrnn_opt.check.plans.motion import Motion
from rrnn_opt.check.plans.reading import polished
from rrnn_opt.check.plans.robot.block import read_model

TURN = (np.array([1.0, 2.0, -3.0, 1.5]) / np.linalg.norm([1, 2, -3, 1.5])).tolist()
PLACED = {"position": [0.4, -0.3, 0.6], "quat_xyzw": TURN}
SOLIDS = [
    {"type": "box", "size": [0.2, 0.3, 0.1], **PLACED},
    {"type": "cylinder", "radius": 0.1, "length": 0.3, **PLACED},
    {"type": "capsule", "radius": 0.1, "length": 0.3, **PLACED},
    {"type": "sphere", "radius": 0.2, "position": [-0.5, 0.4, 0.2]},
    {"type": "halfspace", "normal": [0.6, 0.0, 0.8], "offset": -0.1},
]
PROBLEM = {"obstacles": SOLIDS, "margin": 0.01}


def case(robot, seed, rows=3, size=1.0):
    """A scene, a motion and its whole boxes, in doubles and in balls."""
    model, rng = read_model(robot), np.random.default_rng(seed)
    low, high = np.maximum(model.lower, -2), np.minimum(model.upper, 2)
    q = rng.uniform(low, high, (rows, model.nv)) * size
    qd = rng.normal(size=(rows, model.nv)) * 0.3
    motion = Motion.of(np.arange(rows) * 0.37, q, qd)
    scene = inputs.read_scene(Parts.of(model), PROBLEM, motion)
    boxes = Boxes.whole(0, rows - 1).halves(np.arange(rows - 1))
    boxes = boxes.halves(np.arange(len(boxes.half)))
    now = poses(scene.model, scene.joint, boxes, scene.errors)
    return scene, boxes, now, BallScene(robot, PROBLEM, scene, motion)


def off(row, balls):
    apart = [flint.arb(float(a)) - b for a, b in zip(row, balls, strict=True)]
    return float(length(apart).upper())


def moments(boxes, exact):
    rows = zip(boxes.piece, boxes.middle, boxes.half, strict=True)
    return [exact.moment(int(p), float(m), float(h)) for p, m, h in rows]


@pytest.mark.parametrize("scale", [1.0, 300.0])
def test_kinematics_stay_within_their_bounds(robot, scale):
    """Every origin, axis, centre and move; the bound is not vastly too large."""
    worst = 0.0
    with flint.ctx.workprec(PRECISION):
        scene, boxes, now, exact = case(robot, 1, size=scale)
        errors, model = scene.errors, scene.model
        for row, moment in enumerate(moments(boxes, exact)):
            for k in range(model.nj):
                miss = off(now.axes[k, :, row], moment.pose.axes[k])
                assert miss <= errors.axes[k]
                miss = off(now.origins[k, :, row], moment.pose.origins[k])
                assert miss <= errors.origins[k]
                assert moment.sway[k] <= flint.arb(now.sway[k, row])
                assert now.sway[k, row] <= errors.sways[k] + 2 * errors.values[k]
            for i in range(len(model.radii)):
                miss = off(now.centres[:, i, row], exact.body.centre(moment.pose, i))
                assert miss <= errors.centres[i]
                worst = max(worst, miss / (errors.centres[i] + 1e-300))
    assert worst > 1e-5


def levels(scene):
    for target in scene.targets:
        while target is not None:
            if target.count:
                yield target
            target = None if target.finer is None else target.finer.target


@pytest.mark.parametrize(("seed", "scale"), [(2, 1.0), (3, 1.0), (4, 3e4)])
def test_no_bound_exceeds_the_true_one_by_more_than_the_slack(robot, seed, scale):
    """Distance, travel and sharp bound of every kind of pair, coarse and fine."""
    rng, worst = np.random.default_rng(seed), 0.0
    with flint.ctx.workprec(PRECISION):
        scene, boxes, now, exact = case(robot, seed, size=scale)
        found = moments(boxes, exact)
        for target in levels(scene):
            box = rng.integers(0, len(boxes.half), 25)
            pair = rng.integers(0, target.count, 25)
            cheap = target.distance(now, box, pair) - target.travel(now, box, pair)
            sharp = target.sharp(now, box, pair)
            shown = target.first(now).shown.reshape(target.count, -1)[pair, box]
            rooms = np.broadcast_to(target.room(pair), 25)
            for row in range(25):
                at, room = found[box[row]], float(rooms[row])
                travel, bend, gap = exact.parts(target, int(pair[row]), at)
                over = flint.arb(sharp[row]) - (gap - bend)
                assert over < flint.arb(room)
                if gap + exact.radii(target, int(pair[row])) > 0:  # centre outside
                    assert flint.arb(cheap[row]) - (gap - travel) < room
                    assert flint.arb(shown[row]) - (gap - travel) < room
                worst = max(worst, float(abs(over).upper()) / room)
    assert worst > 1e-5


def test_the_slack_is_tiny_and_grows_with_the_numbers(robot):
    near = case(robot, 4)[0].rounding_bound
    far = case(robot, 4, size=1000.0)[0].rounding_bound
    assert 1e-15 < near < 1e-9
    assert far > 5 * near


def test_placements_are_polished_to_the_nearest_rotation():
    """Up to the tolerance of documents, 1e-9, and from exact ones."""
    rng = np.random.default_rng(5)
    for noise in (0.0, 1e-16, 1e-12, 2e-10):
        q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        given = q * np.sign(np.linalg.det(q)) + noise * rng.uniform(-1, 1, (3, 3))
        with flint.ctx.workprec(PRECISION):
            wanted = nearest_rotation(given)
            flat = [wanted[i, j] for i in range(3) for j in range(3)]
            assert off(polished(given).ravel(), flat) <= 24 * U
            gram = wanted.transpose() * wanted
            assert abs(gram[0, 0] - 1) < 1e-25
            assert abs(gram[0, 1]) < 1e-25
