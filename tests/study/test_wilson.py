import math

import pytest

from rrnn_opt.errors import RrnnError
from rrnn_opt.study import wilson


@pytest.mark.parametrize(
    ("k", "n"), [(0, 10), (10, 10), (46, 50), (36, 50), (1, 1), (500, 1000)]
)
def test_the_limits_solve_wilsons_equation(k, n):
    """(p - k/n)^2 = z^2 p (1 - p) / n at both limits."""
    z = 1.959963984540054
    for p in wilson(k, n):
        assert (p - k / n) ** 2 == pytest.approx(z * z * p * (1 - p) / n, abs=1e-12)


def test_the_interval_holds_the_proportion_and_narrows():
    wide, narrow = wilson(30, 50), wilson(600, 1000)
    assert wide[0] < narrow[0] < 0.6 < narrow[1] < wide[1]
    loose = wilson(30, 50, confidence=0.8)
    assert wide[0] < loose[0] < loose[1] < wide[1]


def test_no_cases_say_nothing():
    assert wilson(0, 0) == (0.0, 1.0)


@pytest.mark.parametrize(("k", "n"), [(-1, 3), (4, 3)])
def test_impossible_counts_are_refused(k, n):
    with pytest.raises(RrnnError, match="successes"):
        wilson(k, n)


def test_the_paper_s_three_schemes_overlap():
    """46, 36 and 37 of 50: the last two cannot be told apart."""
    one, two = wilson(36, 50), wilson(37, 50)
    assert two[0] < one[1]
    assert math.isclose(wilson(46, 50)[0], 0.8117, abs_tol=1e-3)
