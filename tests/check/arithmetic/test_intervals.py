"""The checker's intervals against exact rational arithmetic."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from rrnn_opt.check.arithmetic import ball_intervals, intervals

numbers = st.floats(
    allow_nan=False, allow_infinity=False, max_value=1e150, min_value=-1e150
)
EXACT = {
    "add": lambda x, y: x + y,
    "sub": lambda x, y: x - y,
    "mul": lambda x, y: x * y,
    "fmin": min,
    "fmax": max,
    "le": lambda x, y: Fraction(x <= y),
    "lt": lambda x, y: Fraction(x < y),
}


def made(a: float, b: float) -> np.ndarray:
    low, high = sorted((a, b))
    return intervals.interval(np.array([low]), np.array([high]))


@given(numbers, numbers, numbers, numbers, st.sampled_from(sorted(EXACT)))
@example(1e-200, 1e-200, 1e-200, 1e-200, "mul")
@example(0.0, 5e-324, 1e-10, 1.0, "mul")
@example(0.0, 1.0, 0.0, 0.0, "mul")
def test_every_combination_of_ends_is_inside(a, b, c, d, name):
    found = getattr(intervals, name)(made(a, b), made(c, d))
    low, high = float(intervals.lower(found)[0]), float(intervals.upper(found)[0])
    for x in (a, b):
        for y in (c, d):
            exact = EXACT[name](Fraction(x), Fraction(y))
            assert Fraction(low) <= exact <= Fraction(high)


@given(numbers, numbers)
def test_squares_roots_and_inverses(a, b):
    x = made(a, b)
    square = intervals.sq(x)
    for end in (a, b):
        exact = Fraction(end) ** 2
        assert Fraction(float(intervals.lower(square)[0])) <= exact
        assert exact <= Fraction(float(intervals.upper(square)[0]))
    root = intervals.sqrt(intervals.fabs(x))
    for end in (abs(a), abs(b)):
        high = Fraction(float(intervals.upper(root)[0]))
        assert high**2 >= Fraction(end)
    with np.errstate(all="ignore"):
        inverse = intervals.inv(x)
    if min(a, b) <= 0.0 <= max(a, b):
        assert np.all(np.isnan(inverse))


def test_exact_zeros_stay_exact():
    zero, wide = made(0.0, 0.0), made(0.0, 2.0)
    assert np.all(intervals.mul(zero, wide) == 0.0)
    assert intervals.lower(intervals.mul(wide, wide))[0] == 0.0
    assert intervals.upper(intervals.sub(zero, zero))[0] == 0.0


@pytest.mark.parametrize("name", ["sin", "cos"])
def test_waves_agree_with_balls(name):
    rng = np.random.default_rng(0)
    low = rng.uniform(-50.0, 50.0, 500)
    high = low + 10.0 ** rng.uniform(-6, 1, 500)
    found = getattr(intervals, name)(intervals.interval(low, high))
    for k in range(500):
        ball = getattr(ball_intervals, name)(ball_intervals.interval(low[k], high[k]))
        assert not ball[0] < found[0, k] * -1.0
        assert not ball[1] > found[1, k]
        assert float(ball[1]) == pytest.approx(float(found[1, k]), abs=1e-12)
