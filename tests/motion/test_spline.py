import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.motion.path import Path
from rrnn_opt.motion.spline import SmoothPath


def smooth(points, spacing=0.1, scale=1.0):
    return SmoothPath(Path(points), spacing=spacing, scale=scale)


@settings(max_examples=40)
@given(seed=st.integers(0, 10**6), spacing=st.floats(0.02, 2.0))
def test_it_stays_in_the_box_of_its_polyline(seed, spacing):
    points = np.random.default_rng(seed).normal(size=(5, 3))
    q = smooth(points, spacing)(np.linspace(0, 1, 400))
    assert np.all(q >= points.min(axis=0) - 1e-12)
    assert np.all(q <= points.max(axis=0) + 1e-12)
    np.testing.assert_allclose(q[[0, -1]], points[[0, -1]], atol=1e-12)


def test_a_straight_line_is_followed_at_even_speed():
    curve, s = smooth([[0.0, 0.0], [3.0, 4.0]]), np.linspace(0, 1, 50)
    np.testing.assert_allclose(curve(s), s[:, None] * [3.0, 4.0], atol=1e-12)
    np.testing.assert_allclose(curve(s, 1), np.tile([3.0, 4.0], (50, 1)), atol=1e-9)
    np.testing.assert_allclose(curve(s, 2), 0.0, atol=1e-7)


@pytest.mark.parametrize("spacing", [0.2, 0.1, 0.05])
def test_a_corner_is_missed_by_less_than_half_a_span(spacing):
    corner = [1.0, 0.0]
    curve = smooth([[0.0, 0.0], corner, [1.0, 1.0]], spacing)
    away = np.linalg.norm(curve(np.linspace(0, 1, 5001)) - corner, axis=1).min()
    assert away < spacing / 2


def test_the_grid_holds_every_knot():
    curve = smooth([[0.0], [1.0]], 0.1)
    grid = curve.grid(100)
    assert len(grid) >= 101
    for knot in np.linspace(0, 1, curve.spans + 1):
        assert np.abs(grid - knot).min() < 1e-12


def test_a_bend_gets_more_steps_than_a_straight_stretch():
    """Round the only corner of an L; the spans elsewhere take one step each."""
    curve = smooth([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]], 0.1)
    grid = curve.grid(1, bent=3)
    knots = np.linspace(0, 1, curve.spans + 1)
    for knot in knots:
        assert np.abs(grid - knot).min() < 1e-12
    steps, _ = np.histogram(grid[:-1] + 1e-9, knots)
    middle = (knots[:-1] + knots[1:]) / 2
    ends = np.stack(
        [curve(middle - 0.4 / curve.spans), curve(middle + 0.4 / curve.spans)]
    )
    bends = np.ptp(ends, axis=0).min(axis=1) > 1e-6  # moves along both axes
    assert 2 <= bends.sum() <= 6
    np.testing.assert_array_equal(steps[bends], 3)
    assert steps[:5].tolist() == steps[-5:].tolist() == [1] * 5
    assert len(curve.grid(200, bent=3)) >= 201
