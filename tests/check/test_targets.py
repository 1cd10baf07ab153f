"""Each bound over a time box against dense samples of that very box."""

import numpy as np
import pytest

from rrnn_opt.check import hermite, inputs
from rrnn_opt.check.boxes import Boxes, joint_pieces, poses
from rrnn_opt.check.collision import Motion
from rrnn_opt.check.hermite import Pieces
from rrnn_opt.check.model import read_model
from rrnn_opt.check.targets import ObstacleTarget

TURN = (np.array([1.0, 2.0, -3.0, 1.5]) / np.linalg.norm([1, 2, -3, 1.5])).tolist()
OBSTACLES = [
    {"type": "halfspace", "normal": [0.6, 0.0, 0.8], "offset": -3.0},
    {"type": "box", "size": [0.4, 0.6, 0.2], "position": [3, 1, 1], "quat_xyzw": TURN},
    {"type": "sphere", "radius": 0.2, "position": [1.5, -2.5, 1.0]},
]
SAMPLES = 41


def motion_of(model, rng, orders):
    """One piece about its middle with only the given orders of movement."""
    low, high = np.maximum(model.lower, -2), np.minimum(model.upper, 2)
    c = np.zeros((4, 1, model.nv))
    c[0] = rng.uniform(low, high)
    size = np.where(low > -1, 0.2, 1.0) * 10 ** rng.uniform(-2, -0.3)
    for order in orders:
        c[order] = rng.normal(size=model.nv) * size
    # about the middle s = 1, with tau = 1: shift the polynomial by one
    a, b, d, e = c
    shifted = Pieces(np.array([2.0]), a - b + d - e, b - 2 * d + 3 * e, d - 3 * e, e)
    return Motion(np.array([0.0, 2.0]), shifted.c0, shifted)


def at_instants(model, pieces, shares):
    """The robot at instants of the only box, as zero-length boxes."""
    n = len(shares)
    boxes = Boxes(np.zeros(n, dtype=np.int64), pieces.h[0] * shares, np.zeros(n))
    return poses(model, joint_pieces(model, pieces), boxes)


def everything(target, n):
    return np.repeat(np.arange(n), target.count), np.tile(np.arange(target.count), n)


@pytest.mark.parametrize("orders", [(1,), (2,), (3,), (1, 2, 3)])
def test_no_bound_exceeds_the_least_distance_in_its_box(robot, orders):
    model, rng = read_model(robot), np.random.default_rng(len(orders) + orders[0])
    tight = 0
    for _ in range(12):
        motion = motion_of(model, rng, orders)
        targets, _ = inputs.read_targets(model, {"obstacles": OBSTACLES}, motion)
        box = Boxes.whole(motion.pieces, 0, 1)
        now = poses(model, joint_pieces(model, motion.pieces), box)
        dense = at_instants(model, motion.pieces, np.linspace(0, 1, SAMPLES))
        for target in targets:
            if not target.count:
                continue
            rows = everything(target, 1)
            samples = target.distance(dense, *everything(target, SAMPLES))
            least = samples.reshape(SAMPLES, -1).min(axis=0)
            middle = target.distance(now, *rows)
            sharp = target.sharp(now, *rows)
            assert np.all(sharp <= least + 1e-9)
            assert np.all(middle - target.travel(now)[rows] <= least + 1e-9)
            # and it is worth something: half of the approach is explained
            moved = middle - least > 1e-3
            tight += (
                int(np.sum(middle - sharp < 3 * (middle - least))) if moved.any() else 0
            )
    assert tight > 0


def test_a_slide_is_followed_to_its_largest_extension(tree):
    """Extents and reaches hold between rows, where the slide bulges."""
    model = read_model(tree)
    t = np.array([0.0, 1.0])
    q = np.zeros((2, 4))
    qd = np.zeros((2, 4))
    qd[:, 1] = [1.2, -1.2]  # bulges by 0.3 m
    motion = Motion(t, q, hermite.pieces(t, q, qd))
    targets, _ = inputs.read_targets(model, {"obstacles": OBSTACLES}, motion)
    dense = at_instants(model, motion.pieces, np.linspace(0, 1, 101))
    reach = next(t.reach for t in targets if isinstance(t, ObstacleTarget))
    moved = model.sphere_moved_by() & ~model.prismatic
    assert dense.joints[:, 1].max() > 0.29
    away = np.linalg.norm(dense.centres[:, :, None] - dense.origins[:, None], axis=3)
    assert np.all(away.max(axis=0)[moved] <= reach[moved] + 1e-12)
    still = Motion(t, q, hermite.pieces(t, q, 0 * qd))
    shorter = inputs.read_targets(model, {"obstacles": OBSTACLES}, still)[0][0].reach
    assert np.any(away.max(axis=0)[moved] > shorter[moved])
