"""The bound against what forward kinematics does, for turns, slides and trees."""

import numpy as np

from rrnn_opt.check.plans.robot import kinematics
from rrnn_opt.check.plans.robot.block import read_model
from rrnn_opt.check.plans.robot.motion_bound import (
    motion_bound,
    reach_table,
    travel_levers,
)


def centres(model, joints):
    """Sphere centres at the rows of joint values, (N, ns, 3)."""
    frames = kinematics.forward(model, joints.T)
    return np.moveaxis(kinematics.sphere_centres(model, frames), 0, 2).swapaxes(0, 1)


def jacobian(model, joints, step=1e-6):
    """d centre / d joint by central differences, (ns, 3, nj)."""
    columns = []
    for k in range(model.nj):
        e = np.zeros(model.nj)
        e[k] = step
        pair = centres(model, np.stack([joints + e, joints - e]))
        columns.append((pair[0] - pair[1]) / (2 * step))
    return np.stack(columns, axis=-1)


def extents(model, spread=0.4):
    return np.full(model.nj, -spread), np.full(model.nj, spread)


def sample(model, rng, spread=0.4):
    joints = rng.uniform(-3, 3, model.nj)
    return np.where(model.prismatic, rng.uniform(-spread, spread, model.nj), joints)


def rest_and_bound(model, joints, delta, reach, moved):
    moves = np.stack([joints, joints + delta])
    before, after = centres(model, moves)
    rest = after - before - jacobian(model, joints) @ delta
    h = np.broadcast_to(np.abs(delta)[:, None], reach.shape)
    return rest, motion_bound(h, reach, moved, model.prismatic)


def test_reach_is_never_exceeded(robot):
    model, rng = read_model(robot), np.random.default_rng(1)
    reach, moved = reach_table(model, *extents(model)), model.sphere_moved_by.T
    for _ in range(100):
        joints = sample(model, rng)[:, None]
        frames = kinematics.forward(model, joints)
        spheres = kinematics.sphere_centres(model, frames)[..., 0]
        origins = frames.origins[..., 0].T
        away = np.linalg.norm(spheres[:, None] - origins[:, :, None], axis=0)
        turning = moved & ~model.prismatic[:, None]
        assert np.all(away[turning] <= reach[turning] + 1e-12)
        assert np.all(reach[~moved] == 0)


def test_the_rest_never_exceeds_the_bound(robot):
    model, rng = read_model(robot), np.random.default_rng(2)
    reach, moved = reach_table(model, *extents(model, 0.8)), model.sphere_moved_by.T
    worst = 0.0
    for _ in range(150):
        delta = rng.normal(size=model.nj) * 10 ** rng.uniform(-2, -0.3)
        delta = np.where(model.prismatic, np.clip(delta, -0.4, 0.4), delta)
        rest, bound = rest_and_bound(model, sample(model, rng), delta, reach, moved)
        size = np.linalg.norm(rest, axis=1)
        assert np.all(size <= bound / 2 + 1e-9)
        live = bound > 1e-6
        worst = max(worst, float((2 * size[live] / bound[live]).max(initial=0.0)))
    assert worst > 0.02  # not a bound that holds for being absurdly large


def test_the_bound_is_sharp_for_a_stretched_arm(planar):
    """Both joints turn the same way, arm straight: rest -> B / 2."""
    model = read_model(planar)
    reach, moved = reach_table(model, *extents(model)), model.sphere_moved_by.T
    delta = np.array([1e-3, 1e-3])
    rest, bound = rest_and_bound(model, np.zeros(2), delta, reach, moved)
    ratio = 2 * np.linalg.norm(rest[2]) / bound[2]
    assert 0.999 < ratio <= 1.0 + 1e-6


def test_travel_is_never_exceeded(robot):
    model, rng = read_model(robot), np.random.default_rng(3)
    reach, moved = reach_table(model, *extents(model, 0.8)), model.sphere_moved_by.T
    levers = travel_levers(reach, moved, model.prismatic)
    for _ in range(150):
        delta = rng.normal(size=model.nj) * 0.3
        delta = np.where(model.prismatic, np.clip(delta, -0.4, 0.4), delta)
        joints = sample(model, rng)
        before, after = centres(model, np.stack([joints, joints + delta]))
        way = np.linalg.norm(after - before, axis=1)
        assert np.all(way <= np.abs(delta) @ levers + 1e-9)


def test_joints_above_a_common_ancestor_do_not_count(tree):
    """Seen from the last common joint, a sphere moves by the joints below it."""
    model, rng = read_model(tree), np.random.default_rng(4)
    reach, moved = reach_table(model, *extents(model, 0.8)), model.sphere_moved_by.T
    own = moved[:, [2, 4]] & ~moved[:, [4, 2]]
    np.testing.assert_array_equal(own[:, 0], [False, True, True, False, False])
    for _ in range(100):
        joints, delta = sample(model, rng), rng.normal(size=5) * 0.1
        below = delta.copy()
        below[0] = 0.0  # joint 0 moves both alike
        pairs = centres(model, np.stack([joints, joints + delta, joints + below]))
        apart = pairs[:, 2] - pairs[:, 4]
        np.testing.assert_allclose(
            np.linalg.norm(apart[1]), np.linalg.norm(apart[2]), atol=1e-12
        )
        row = jacobian(model, joints)
        rest = apart[2] - apart[0] - (row[2] - row[4]) @ below
        h = np.broadcast_to(np.abs(below)[:, None], (5, 2))
        bound = motion_bound(h, reach[:, [2, 4]], own, model.prismatic)
        assert np.linalg.norm(rest) <= bound.sum() / 2 + 1e-9
