"""The nearest point of a cloud, against all points looked at one by one."""

import numpy as np
import pytest

from rrnn_opt.check.plans.solids.cloud import BLOCK, Cloud


@pytest.mark.parametrize("count", [1, 2, BLOCK, BLOCK + 1, 1000])
def test_nearest_is_the_nearest_of_all(count):
    """One point is its own block's box: rounding alone tells them apart."""
    rng = np.random.default_rng(count)
    points, query = rng.normal(size=(count, 3)), rng.normal(size=(700, 3))
    far, unit = Cloud(points).nearest(query)
    every = np.linalg.norm(points - query[:, None], axis=2)
    np.testing.assert_allclose(far, every.min(axis=1), rtol=1e-14)
    np.testing.assert_allclose(np.linalg.norm(unit, axis=1), 1.0, atol=1e-14)
    back = query - far[:, None] * unit
    at = points[every.argmin(axis=1)]
    np.testing.assert_allclose(back, at, atol=1e-13)


def test_nowhere_is_near_nothing():
    """Rows that are NaN stay so, and leave the others alone."""
    query = np.array([[np.nan, 0.0, 0.0], [3.0, 0.0, 0.0]])
    far, _ = Cloud(np.zeros((1, 3))).nearest(query)
    assert np.isnan(far[0])
    assert far[1] == 3.0
