import numpy as np
from scipy.interpolate import CubicHermiteSpline

from rrnn_opt.report.plan.motion import motion_of, sample


def test_samples_are_those_of_scipys_hermite_spline():
    rng = np.random.default_rng(0)
    t = np.cumsum(rng.uniform(0.1, 1.0, 9))
    q, qd = rng.normal(size=(9, 3)), rng.normal(size=(9, 3))
    rows = {"t": t.tolist(), "q": q.tolist(), "qd": qd.tolist()}
    times = np.sort(np.concatenate([t, rng.uniform(t[0], t[-1], 50)]))
    position, velocity = sample(rows, times)
    spline = CubicHermiteSpline(t, q, qd)
    np.testing.assert_allclose(position, spline(times), atol=1e-12)
    np.testing.assert_allclose(velocity, spline(times, 1), atol=1e-11)


def test_what_was_delivered_comes_first_then_the_path_then_the_start(window):
    delivered = motion_of(window)
    assert delivered.qd is not None
    assert delivered.t[-1] == window["trajectory"]["t"][-1]
    window["trajectory"] = None
    path = motion_of(window)
    assert path.qd is None
    np.testing.assert_allclose(path.q[[0, -1]], [window["path"][0], window["path"][-1]])
    window["path"] = None
    alone = motion_of(window)
    assert not alone.moves
    np.testing.assert_array_equal(alone.q[0], window["problem"]["start"])
