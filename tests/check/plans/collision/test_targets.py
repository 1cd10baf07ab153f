"""Each bound over a time box against dense samples of that very box."""

import numpy as np
import pytest

from rrnn_opt.check.plans import inputs
from rrnn_opt.check.plans.collision.bodies import CELL
from rrnn_opt.check.plans.collision.boxes import Boxes, poses
from rrnn_opt.check.plans.collision.parts import Parts
from rrnn_opt.check.plans.motion import Motion
from rrnn_opt.check.plans.robot import kinematics
from rrnn_opt.check.plans.robot.block import read_model

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
    # about the middle of a piece from -1 to 1
    q = np.concatenate([c[0] - c[1] + c[2] - c[3], c.sum(axis=0)])
    qd = np.concatenate([c[1] - 2 * c[2] + 3 * c[3], c[1] + 2 * c[2] + 3 * c[3]])
    return Motion.of(np.array([0.0, 2.0]), q, qd)


def look(scene, motion, boxes):
    return poses(scene.model, scene.joint, boxes, scene.errors)


def at_instants(scene, motion, shares):
    """The robot at instants of the only piece, as zero-length boxes."""
    n = len(shares)
    return look(scene, motion, Boxes(np.zeros(n, dtype=np.int64), shares, np.zeros(n)))


def everything(target, n):
    return np.repeat(np.arange(n), target.count), np.tile(np.arange(target.count), n)


def levels(scene):
    """All targets, coarse and fine, that have a pair."""
    found = []
    for target in scene.targets:
        while target is not None:
            found += [target] if target.count else []
            target = None if target.finer is None else target.finer.target
    return found


@pytest.mark.parametrize("orders", [(1,), (2,), (3,), (1, 2, 3)])
def test_no_bound_exceeds_the_least_distance_in_its_box(robot, orders):
    model, rng = read_model(robot), np.random.default_rng(len(orders) + orders[0])
    tight = 0
    for _ in range(12):
        motion = motion_of(model, rng, orders)
        scene = inputs.read_scene(Parts.of(model), {"obstacles": OBSTACLES}, motion)
        now = look(scene, motion, Boxes.whole(0, 1))
        dense = at_instants(scene, motion, np.linspace(0, 1, SAMPLES))
        for target in levels(scene):
            rows = everything(target, 1)
            samples = target.distance(dense, *everything(target, SAMPLES))
            least = samples.reshape(SAMPLES, -1).min(axis=0)
            middle = target.distance(now, *rows)
            sharp = target.sharp(now, *rows)
            assert np.all(sharp <= least + 1e-9)
            assert np.all(middle - target.travel(now, *rows) <= least + 1e-9)
            # and it is worth something: half of the approach is explained
            moved = middle - least > 1e-3
            tight += (
                int(np.sum(middle - sharp < 3 * (middle - least))) if moved.any() else 0
            )
    assert tight > 0


def test_a_first_look_at_all_says_what_each_row_says(robot, tmp_path):
    """Every pair in every box at once, against the same rows one by one."""
    rng, mesh, cloud = np.random.default_rng(8), tmp_path / "m.obj", tmp_path / "c.npy"
    np.save(cloud, rng.uniform(-1, 1, (200, 3)) + np.array([0.0, 0.0, 3.0]))
    corners = rng.normal(size=(12, 3)).tolist()
    mesh.write_text("".join("v {} {} {}\n".format(*corner) for corner in corners))
    files = [
        {"type": "mesh", "path": str(mesh), "position": [2.0, 2.0, 2.0]},
        {"type": "points", "path": str(cloud), "radius": 0.02},
    ]
    again = {"type": "box", "size": [0.1, 0.2, 0.3], "position": [-1.0, 0.5, 0.5]}
    model = read_model(robot)
    motion = motion_of(model, rng, (1, 2, 3))
    problem = {"obstacles": [*OBSTACLES, *files, again]}
    scene = inputs.read_scene(Parts.of(model), problem, motion)
    boxes = Boxes.whole(0, 1).halves(np.zeros(1, dtype=np.int64))
    now = look(scene, motion, boxes.halves(np.arange(2)))
    kinds = [t.solids.kind for t in scene.targets[:-1]]
    assert kinds == ["halfspace", "box", "sphere", "mesh", "points"]
    assert scene.targets[1].members == (1, 5)
    for target in levels(scene):
        found = target.first(now)
        solids, own, count = found.d.shape
        assert (solids * own, count) == (target.count, 4)
        box, pair = everything(target, 4)
        d = target.distance(now, box, pair)
        floor = target.floor(now, box, pair, d) - target.travel(now, box, pair)
        for all_of_it, rows in ((found.d, d), (found.shown, floor)):
            flat = all_of_it.reshape(target.count, 4)
            np.testing.assert_allclose(flat[pair, box], rows, rtol=0, atol=1e-13)


def test_a_slide_is_followed_to_its_largest_extension(tree):
    """Extents and reaches hold between rows, where the slide bulges."""
    model = read_model(tree)
    t = np.array([0.0, 1.0])
    q = np.zeros((2, 4))
    qd = np.zeros((2, 4))
    qd[:, 1] = [1.2, -1.2]  # bulges by 0.3 m
    motion = Motion.of(t, q, qd)
    scene = inputs.read_scene(Parts.of(model), {"obstacles": OBSTACLES}, motion)
    model = scene.model
    dense = at_instants(scene, motion, np.linspace(0, 1, 101))
    movers = scene.targets[0].finer.target.movers
    turning = movers.moved & ~model.prismatic[:, None]
    assert dense.joints[1].max() > 0.29
    centres = dense.centres[:, movers.spheres]
    apart = centres[:, None] - dense.origins.swapaxes(0, 1)[:, :, None]  # (3, nj, m, B)
    away = np.linalg.norm(apart, axis=0)
    assert np.all(away.max(axis=2)[turning] <= movers.reach[turning] + 1e-12)
    still = inputs.read_scene(
        Parts.of(model), {"obstacles": OBSTACLES}, Motion.of(t, q, np.zeros_like(qd))
    )
    shorter = still.targets[0].finer.target.movers.reach[:, : len(movers.spheres)]
    assert np.any(away.max(axis=2)[turning] > shorter[turning])


@pytest.mark.parametrize("name", ["panda", "tree"])
def test_every_sphere_lies_in_its_balls(name, request):
    """Of its cell and of its body, wherever the robot is."""
    from rrnn_opt.check.plans.collision.bodies import with_balls
    from rrnn_opt.robot import Robot

    builtin = name == "panda"
    robot = Robot.builtin(name).to_dict() if builtin else request.getfixturevalue(name)
    bodies = with_balls(read_model(robot))
    model, ns = bodies.model, bodies.ns
    rng = np.random.default_rng(3)
    joints = rng.uniform(-1, 1, (model.nj, 20))
    centres = kinematics.sphere_centres(model, kinematics.forward(model, joints))
    assert np.bincount(bodies.cell).max() <= CELL
    for ball in (bodies.cell, bodies.body[:ns], bodies.body[bodies.cell]):
        away = np.linalg.norm(centres[:, :ns] - centres[:, ball], axis=0)
        need = away.max(axis=1) + model.radii[:ns]
        assert np.all(need <= model.radii[ball] + 1e-12)
        assert all(model.links[i] == model.links[b] for i, b in enumerate(ball))
