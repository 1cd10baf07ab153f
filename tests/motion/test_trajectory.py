import csv
import json

import numpy as np
import pytest
from scipy.interpolate import CubicHermiteSpline

from rrnn_opt.errors import NotFiniteError, RetimeError, ShapeError
from rrnn_opt.motion import Trajectory


def rows(seed=0, n=6, nv=2):
    rng = np.random.default_rng(seed)
    t = np.concatenate([[0.0], np.cumsum(rng.uniform(0.1, 1.0, n - 1))])
    return t, rng.normal(size=(n, nv)), rng.normal(size=(n, nv))


def test_between_rows_it_is_scipys_hermite():
    t, q, qd = rows()
    motion = Trajectory.from_rows(t, q, qd)
    spline, times = CubicHermiteSpline(t, q, qd), np.linspace(0, t[-1], 999)[1:-1]
    for k, ours in enumerate(motion.at(times)):
        np.testing.assert_allclose(ours, spline(times, nu=k), atol=1e-9)
    np.testing.assert_allclose(motion.qdd[:-1], spline(t[:-1], nu=2), atol=1e-9)
    assert motion.duration == t[-1]


def test_rows_are_met_and_times_outside_are_the_ends():
    t, q, qd = rows()
    motion = Trajectory.from_rows(t, q, qd)
    at = motion.at(t)
    np.testing.assert_allclose(at[0], q, atol=1e-12)
    np.testing.assert_allclose(at[1], qd, atol=1e-12)
    np.testing.assert_allclose(at[2][:-1], motion.qdd[:-1], atol=1e-9)
    np.testing.assert_allclose(motion.at(-5.0)[0], q[0])
    np.testing.assert_allclose(motion.at(1e9)[0], q[-1], atol=1e-12)
    assert motion.at(0.3)[0].shape == (2,)


def test_a_stretch_slows_down_and_keeps_the_path():
    motion = Trajectory.from_rows(*rows())
    slow = motion.stretched(3.0)
    times = np.linspace(0, motion.duration, 50)
    fast_q, fast_qd, fast_qdd = motion.at(times)
    q, qd, qdd = slow.at(3 * times)
    np.testing.assert_allclose(q, fast_q, atol=1e-12)
    np.testing.assert_allclose(qd, fast_qd / 3, atol=1e-12)
    np.testing.assert_allclose(qdd, fast_qdd / 9, atol=1e-9)
    with pytest.raises(RetimeError):
        motion.stretched(0.0)


def test_a_dict_and_back_through_json_loses_nothing():
    motion = Trajectory.from_rows(*rows())
    again = Trajectory.from_dict(json.loads(json.dumps(motion.to_dict())))
    for name in ("t", "q", "qd", "qdd"):
        np.testing.assert_array_equal(getattr(again, name), getattr(motion, name))


def test_csv_holds_every_digit(tmp_path):
    motion = Trajectory.from_rows(*rows())
    motion.write_csv(tmp_path / "trajectory.csv")
    with (tmp_path / "trajectory.csv").open() as stream:
        head, *lines = list(csv.reader(stream))
    assert head == ["t", "q1", "q2", "qd1", "qd2", "qdd1", "qdd2"]
    table = np.array(lines, dtype=float)
    wanted = np.column_stack([motion.t, motion.q, motion.qd, motion.qdd])
    np.testing.assert_array_equal(table, wanted)


def test_malformed_rows_are_refused():
    t, q, qd = rows()
    with pytest.raises(ShapeError):
        Trajectory.from_rows(t, q[:-1], qd)
    with pytest.raises(ShapeError):
        Trajectory.from_rows(t, q, qd[:, :1])
    with pytest.raises(ShapeError):
        Trajectory.from_rows([0.0], q[:1], qd[:1])
    with pytest.raises(NotFiniteError):
        Trajectory.from_rows(t, q * np.nan, qd)
    with pytest.raises(RetimeError):
        Trajectory.from_rows(t[::-1], q, qd)


def test_rows_cannot_be_changed():
    motion = Trajectory.from_rows(*rows())
    for name in ("t", "q", "qd", "qdd"):
        with pytest.raises(ValueError, match="read-only"):
            getattr(motion, name)[0] = 1.0
