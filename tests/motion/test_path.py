import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.errors import NotFiniteError, ShapeError
from rrnn_opt.motion import Path


def polyline(seed, n=6, nv=3):
    return np.random.default_rng(seed).normal(size=(n, nv))


def test_length_and_points_of_a_known_path():
    path = Path([[0.0, 0.0], [3.0, 4.0], [3.0, 5.0]])
    assert path.length == 6.0
    np.testing.assert_allclose(path.arcs, [0, 5, 6])
    np.testing.assert_allclose(path.at([2.5, 5.5]), [[1.5, 2.0], [3.0, 4.5]])
    np.testing.assert_array_equal(path.at([-1.0, 99.0]), [[0, 0], [3, 5]])


@settings(max_examples=50)
@given(seed=st.integers(0, 10**6), spacing=st.floats(0.05, 3.0))
def test_resampling_keeps_the_ends_and_stays_on_the_path(seed, spacing):
    path = Path(polyline(seed))
    fine = path.resampled(spacing)
    np.testing.assert_array_equal(fine.start, path.start)
    np.testing.assert_array_equal(fine.goal, path.goal)
    steps = np.linalg.norm(np.diff(fine.waypoints, axis=0), axis=1)
    assert steps.max() <= spacing + 1e-9
    assert fine.length <= path.length + 1e-9
    for point in fine.waypoints:  # distance to the nearest segment
        a, b = path.waypoints[:-1], path.waypoints[1:]
        share = np.einsum("ij,ij->i", point - a, b - a) / np.sum((b - a) ** 2, axis=1)
        foot = a + np.clip(share, 0, 1)[:, None] * (b - a)
        assert np.linalg.norm(point - foot, axis=1).min() < 1e-9


def test_duplicates_go_and_the_ends_stay():
    points = [[0.0], [0.0], [1e-12], [1.0], [1.0 + 1e-10], [1.0 + 2e-10]]
    kept = Path(points).without_duplicates().waypoints
    np.testing.assert_array_equal(kept, [[0.0], [1.0 + 2e-10]])
    assert len(Path([[1.0], [1.0]]).without_duplicates().waypoints) == 1
    tiny = Path([[0.0], [1e-12]]).without_duplicates().waypoints
    np.testing.assert_array_equal(tiny, [[0.0], [1e-12]])


def test_malformed_waypoints_are_refused():
    for bad in ([1.0, 2.0], [], [[]], np.zeros((0, 3))):
        with pytest.raises(ShapeError):
            Path(bad)
    with pytest.raises(NotFiniteError):
        Path([[0.0], [np.nan]])


def test_a_path_cannot_be_changed():
    path = Path([[0.0], [1.0]])
    with pytest.raises(ValueError, match="read-only"):
        path.waypoints[0, 0] = 5.0
