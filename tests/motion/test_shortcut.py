from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.motion import Path, shortcut


def always(a, b):
    return True


def never(a, b):
    return False


def clear_of_disc(a, b, radius=1.0):
    """Exact: the segment misses the disc about the origin."""
    d = b - a
    share = np.clip(-(a @ d) / max(d @ d, 1e-300), 0, 1)
    return bool(np.linalg.norm(a + share * d) > radius)


def detour(n=40):
    """A jagged way around the disc, every segment clear."""
    angle = np.linspace(0, np.pi, n)
    radius = 1.6 + 0.3 * (-1.0) ** np.arange(n)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)


def test_in_free_space_a_straight_line_remains():
    points = np.random.default_rng(0).normal(size=(9, 3))
    short = shortcut(points, always, rng=np.random.default_rng(0))
    np.testing.assert_array_equal(short, points[[0, -1]])


def test_nothing_changes_when_nothing_is_free():
    points = np.random.default_rng(0).normal(size=(9, 3))
    np.testing.assert_array_equal(
        shortcut(points, never, rng=np.random.default_rng(0)), points
    )


@settings(max_examples=25)
@given(seed=st.integers(0, 10**6))
def test_every_segment_stays_proved_and_the_path_gets_shorter(seed):
    points = detour()
    short = shortcut(points, clear_of_disc, rng=np.random.default_rng(seed))
    np.testing.assert_array_equal(short[[0, -1]], points[[0, -1]])
    for a, b in pairwise(short):
        # parts of proved segments are proved up to rounding of their ends
        assert clear_of_disc(a, b, radius=1.0 - 1e-9)
    assert Path(short).length < 0.8 * Path(points).length


def test_the_same_seed_gives_the_same_path():
    first, second, other = (
        shortcut(detour(), clear_of_disc, rng=np.random.default_rng(seed), attempts=30)
        for seed in (1, 1, 2)
    )
    np.testing.assert_array_equal(first, second)
    assert first.shape != other.shape or not np.array_equal(first, other)


def test_more_attempts_are_never_longer_from_the_same_seed():
    lengths = [
        Path(
            shortcut(detour(), clear_of_disc, rng=np.random.default_rng(3), attempts=n)
        ).length
        for n in (0, 10, 100)
    ]
    assert lengths == sorted(lengths, reverse=True)


@pytest.mark.parametrize("points", [[[1.0, 2.0]], [[1.0, 2.0], [1.0, 2.0]]])
def test_a_single_point_stays(points):
    short = shortcut(points, never, rng=np.random.default_rng(0))
    np.testing.assert_array_equal(short, [[1.0, 2.0]])
