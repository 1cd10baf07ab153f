"""Oracles: dense evaluation by scipy-checked cubics, and known optimal times."""

import logging

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.check.plans import hermite
from rrnn_opt.errors import NotFiniteError, RetimeError, ShapeError
from rrnn_opt.motion import retime


def corners(seed, n=5, nv=4, size=1.0):
    return np.random.default_rng(seed).uniform(-size, size, (n, nv))


@settings(max_examples=15)
@given(seed=st.integers(0, 10**6), spacing=st.sampled_from([0.3, 0.1, 0.05]))
def test_limits_hold_between_rows_and_ends_are_exact(seed, spacing, limits_of, dense):
    points, limits = corners(seed), limits_of(4)
    motion = retime(points, limits, spacing=spacing)
    np.testing.assert_array_equal(motion.q[[0, -1]], points[[0, -1]])
    assert not motion.qd[[0, -1]].any()
    assert motion.t[0] == 0.0
    assert np.all(np.diff(motion.t) > 0)
    speed, push = dense(motion, limits)
    assert speed <= 1
    assert push <= 1
    p = motion.pieces
    for (low, high), limit in (
        (hermite.velocity_range(p), limits.velocity),
        (hermite.acceleration_range(p), limits.acceleration),
    ):
        assert np.maximum(np.abs(low), np.abs(high)).max() <= limit[0]


def test_a_straight_line_takes_its_optimal_time(limits_of):
    """Bang-cruise-bang: L / v + v / a."""
    motion = retime([[0.0], [2.0]], limits_of(1))
    assert 1.0 <= motion.duration / (2.0 / 2.0 + 2.0 / 10.0) < 1.03
    short = retime([[0.0], [0.1]], limits_of(1))  # never reaches full speed
    assert 1.0 <= short.duration / (2 * np.sqrt(0.1 / 10.0)) < 1.03


@pytest.mark.parametrize("length", [1.0, 1e-2, 1e-4, 1e-5])
def test_tiny_paths_are_timed_like_large_ones(length, limits_of, dense):
    limits = limits_of(3)
    motion = retime(corners(3, nv=3) * length, limits)
    speed, push = dense(motion, limits)
    assert max(speed, push) <= 1
    assert max(speed, push) > 0.9


@pytest.mark.parametrize("points", [[[0.3, 0.1]], [[0.3, 0.1]] * 5])
def test_a_path_that_goes_nowhere_is_trivial(points, limits_of):
    motion = retime(points, limits_of(2))
    np.testing.assert_array_equal(motion.q, [[0.3, 0.1]] * 2)
    assert not motion.qd.any()
    assert motion.duration > 0


def test_a_barely_moving_path_keeps_both_ends(limits_of):
    points = [[0.3, 0.1], [0.3, 0.1 + 1e-10]]
    np.testing.assert_array_equal(retime(points, limits_of(2)).q, points)


def test_duplicates_change_nothing(limits_of):
    points = corners(8)
    doubled = np.repeat(points, 3, axis=0)
    np.testing.assert_array_equal(
        retime(doubled, limits_of(4)).q, retime(points, limits_of(4)).q
    )


def test_a_dense_noisy_path_keeps_its_limits(limits_of, dense):
    rng, limits = np.random.default_rng(1), limits_of(3)
    line = np.linspace(0, 1, 300)[:, None] * [1.0, -0.5, 0.3]
    motion = retime(line + rng.normal(size=(300, 3)) * 1e-3, limits, spacing=0.02)
    assert max(dense(motion, limits)) <= 1


def test_waypoints_on_a_limit_do_not_leave_it(limits_of):
    limits = limits_of(2, bound=1.0)
    points = [[-1.0, 1.0], [1.0, 1.0], [1.0, -1.0], [0.3, -1.0], [0.3, 0.9]]
    low, high = hermite.position_range(retime(points, limits).pieces)
    assert high.max() <= 1.0 + 1e-10
    assert low.min() >= -1.0 - 1e-10


def test_waypoints_outside_the_limits_are_refused(limits_of):
    with pytest.raises(RetimeError, match="position limits") as caught:
        retime([[0.0, 0.0], [4.0, 0.0]], limits_of(2))
    assert caught.value.reason == "position limits"


def test_malformed_input_is_refused(limits_of):
    with pytest.raises(NotFiniteError):
        retime([[0.0], [np.nan]], limits_of(1))
    with pytest.raises(ShapeError):
        retime([0.0, 1.0], limits_of(1))
    with pytest.raises(ShapeError):
        retime([[0.0], [1.0]], limits_of(3))
    with pytest.raises(RetimeError, match="spacing"):
        retime([[0.0], [1.0]], limits_of(1), spacing=0.0)


def test_a_failing_retimer_is_named(limits_of, monkeypatch):
    from toppra import algorithm

    def fail(self, *_):
        code = algorithm.ParameterizationReturnCode
        self.problem_data.return_code = code.FailUncontrollable

    monkeypatch.setattr(algorithm.TOPPRA, "compute_parameterization", fail)
    with pytest.raises(RetimeError) as caught:
        retime([[0.0], [1.0]], limits_of(1))
    assert "ncontrollable" in caught.value.reason


def test_toppra_says_nothing_and_its_logger_is_left_as_it_was(limits_of, caplog):
    logging.getLogger("toppra").setLevel(logging.INFO)
    try:
        retime(corners(2), limits_of(4))
        assert logging.getLogger("toppra").level == logging.INFO
    finally:
        logging.getLogger("toppra").setLevel(logging.NOTSET)
    assert not caplog.records


def test_the_same_input_gives_the_same_rows(limits_of):
    first, second = (retime(corners(4), limits_of(4)) for _ in range(2))
    for name in ("t", "q", "qd", "qdd"):
        np.testing.assert_array_equal(getattr(first, name), getattr(second, name))


@pytest.mark.parametrize("name", ["pa10", "panda", "planar3", "raven2"])
def test_every_built_in_arm_is_timed(name, dense):
    from rrnn_opt.robot import Robot

    limits = Robot.builtin(name).limits
    rng = np.random.default_rng(6)
    points = rng.uniform(limits.lower, limits.upper, (5, len(limits.lower)))
    motion = retime(points, limits)
    assert max(dense(motion, limits)) <= 1
