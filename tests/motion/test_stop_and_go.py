import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.errors import NotFiniteError, RetimeError, ShapeError
from rrnn_opt.motion import stop_and_go


@settings(max_examples=40)
@given(seed=st.integers(0, 10**6), scale=st.sampled_from([1e-7, 1e-3, 1.0, 10.0]))
def test_it_runs_on_the_polyline_within_its_limits(seed, scale, limits_of, dense):
    points = np.random.default_rng(seed).normal(size=(4, 3)) * scale
    limits = limits_of(3)
    motion = stop_and_go(points, limits)
    np.testing.assert_array_equal(motion.q, points)
    assert not motion.qd.any()
    q, _, _ = motion.at(np.linspace(0, motion.duration, 500))
    a, b = points[:-1], points[1:]
    for point in q:
        share = np.einsum("ij,ij->i", point - a, b - a) / np.sum((b - a) ** 2, axis=1)
        foot = a + np.clip(share, 0, 1)[:, None] * (b - a)
        assert np.linalg.norm(point - foot, axis=1).min() < 1e-12 * max(1, scale)
    speed, push = dense(motion, limits, 2001)
    assert speed <= 1
    assert push <= 1


def test_it_is_as_fast_as_its_form_allows(limits_of, dense):
    limits = limits_of(1)
    speed, push = dense(stop_and_go([[0.0], [0.1]], limits), limits)
    assert push == pytest.approx(1.0, abs=1e-6)
    speed, push = dense(stop_and_go([[-2.5], [2.5]], limits), limits)
    assert speed == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("points", [[[0.5, 0.2]], [[0.5, 0.2]] * 4])
def test_a_motion_that_goes_nowhere_has_two_rows(points, limits_of):
    motion = stop_and_go(points, limits_of(2))
    np.testing.assert_array_equal(motion.q, [[0.5, 0.2]] * 2)
    assert motion.duration == 1e-3


def test_malformed_input_is_refused(limits_of):
    with pytest.raises(NotFiniteError):
        stop_and_go([[0.0], [np.inf]], limits_of(1))
    with pytest.raises(ShapeError):
        stop_and_go([[0.0], [1.0]], limits_of(2))
    for name, value, error in (
        ("velocity", np.zeros(1), RetimeError),
        ("acceleration", np.full(1, np.inf), NotFiniteError),
    ):
        limits = limits_of(1)
        setattr(limits, name, value)
        with pytest.raises(error, match=name):
            stop_and_go([[0.0], [1.0]], limits)
