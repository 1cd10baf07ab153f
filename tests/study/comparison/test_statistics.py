"""Statistics on cases whose answers are known."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rrnn_opt.errors import RrnnError
from rrnn_opt.study.comparison.statistics import (
    data_profile,
    percentiles,
    performance_profile,
    shifted_geometric_mean,
    spread,
)

INF = np.inf


def test_shifted_geometric_mean_of_known_numbers():
    assert shifted_geometric_mean([0.0, 3.0], 1.0) == pytest.approx(1.0)
    assert shifted_geometric_mean([7.0], 10.0) == pytest.approx(7.0)
    assert shifted_geometric_mean([1.0, 100.0], 1e-9) == pytest.approx(10.0)


@given(
    st.lists(st.floats(0.0, 1e6), min_size=1, max_size=20),
    st.floats(1e-3, 1e3),
)
def test_shifted_geometric_mean_lies_between_the_geometric_and_the_plain_mean(v, shift):
    from scipy.stats import gmean

    found = shifted_geometric_mean(v, shift)
    assert found <= np.mean(v) + 1e-6 * (1.0 + np.mean(v))
    assert found >= gmean(np.array(v) + 1e-12) - 1e-6 * (1.0 + np.mean(v))


@pytest.mark.parametrize(("values", "shift"), [([], 1), ([-1], 1), ([1], 0)])
def test_shifted_geometric_mean_refuses_what_has_none(values, shift):
    with pytest.raises(RrnnError, match="shifted geometric mean"):
        shifted_geometric_mean(values, shift)


def test_a_performance_profile_worked_out_by_hand():
    """Best times 1, 2, 4; nobody solved the last problem."""
    times = [[1.0, 4.0, INF, INF], [2.0, 2.0, 4.0, INF]]
    found = performance_profile(times, [1.0, 2.0, 100.0])
    np.testing.assert_allclose(found, [[0.25, 0.5, 0.5], [0.5, 0.75, 0.75]])


def test_a_data_profile_worked_out_by_hand():
    found = data_profile([[1.0, 4.0, INF]], [0.5, 1.0, 10.0])
    np.testing.assert_allclose(found, [[0.0, 1 / 3, 2 / 3]])


def test_profiles_rise_and_the_best_leads_at_one():
    times = np.random.default_rng(0).lognormal(size=(5, 40))
    curves = performance_profile(times, np.geomspace(1, 100, 30))
    assert (np.diff(curves, axis=1) >= 0).all()
    assert curves[:, 0].sum() == pytest.approx(1.0)


def test_percentiles_and_spread():
    assert percentiles(range(1001))["p999"] == pytest.approx(999.0)
    assert percentiles([3.0])["max"] == 3.0
    assert spread([[1.0, 10.0], [1.0, 10.0]]) == 0.0
    assert spread([[1.0], [2.0], [3.0]]) == pytest.approx(0.5)


def test_wilson_is_that_of_statsmodels():
    proportion = pytest.importorskip(
        "statsmodels.stats.proportion", reason="statsmodels is not installed"
    )
    from rrnn_opt.study import wilson

    for k, n in ((0, 7), (3, 7), (7, 7), (50, 1000)):
        theirs = proportion.proportion_confint(k, n, method="wilson")
        assert wilson(k, n) == pytest.approx(theirs, abs=1e-12)
