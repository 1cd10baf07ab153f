import numpy as np

from rrnn_opt.report.plan.clearance import sampled_clearance
from rrnn_opt.report.plan.pose import joint_frames, sphere_centres
from rrnn_opt.scene import HalfSpace, Sphere


def test_the_nearest_pair_counts(pa10, window):
    ball = Sphere("ball", 0.1, [0.9, 0.0, 0.4])
    floor = HalfSpace("floor", [0.0, 0.0, 1.0], -0.5)
    q = np.array([window["path"][0], window["path"][-1]])
    centres, radii = sphere_centres(pa10, joint_frames(pa10, q))
    to_ball = np.linalg.norm(centres - [0.9, 0.0, 0.4], axis=2) - 0.1 - radii
    to_floor = centres[..., 2] + 0.5 - radii
    wanted = np.minimum(to_ball, to_floor).min(axis=1)
    found = sampled_clearance(pa10, [ball, floor], q)
    np.testing.assert_allclose(found.distance, wanted)
    near = found.closest
    assert near.distance == np.min(wanted)
    assert near.sample == np.argmin(wanted)
    assert near.obstacle == int(to_floor.min() < to_ball.min())
    apart = np.linalg.norm(near.ends[0] - near.ends[1])
    np.testing.assert_allclose(apart, abs(near.distance), atol=1e-12)
    assert near.link in {sphere["link"] for sphere in pa10["spheres"]}


def test_without_obstacles_or_moving_spheres_there_is_no_curve(pa10):
    assert sampled_clearance(pa10, [], np.zeros((1, 7))) is None
    fixed = [{**s, "joint": -1} for s in pa10["spheres"]]
    ball = Sphere("ball", 0.1, [0.9, 0.0, 0.4])
    still = {**pa10, "spheres": fixed}
    assert sampled_clearance(still, [ball], np.zeros((1, 7))) is None
