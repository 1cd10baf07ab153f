import casadi as ca
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.errors import RrnnError
from rrnn_opt.formulations.acceleration_limits import (
    acceleration_bounds,
    braking_bounds,
)
from rrnn_opt.robot import Limits

LAWS = settings(max_examples=80)
SHARES = st.lists(st.floats(0, 1), min_size=3, max_size=3).map(np.array)
LIMITS = Limits(
    lower=np.array([-1.0, -np.inf, 0.2]),
    upper=np.array([2.0, np.inf, 0.4]),
    velocity=np.array([0.5, 1.5, 0.2]),
    acceleration=np.array([3.0, 2.0, 1.0]),
)
OMEGA = LIMITS.acceleration / LIMITS.velocity
LOW = np.where(np.isfinite(LIMITS.lower), LIMITS.lower, -10.0)
HIGH = np.where(np.isfinite(LIMITS.upper), LIMITS.upper, 10.0)


def numbers(make, q, qd, **gains):
    a, b = ca.SX.sym("q", 3), ca.SX.sym("qd", 3)
    f = ca.Function("f", [a, b], [*make(a, b, LIMITS, **gains)])
    return tuple(np.asarray(side).ravel() for side in f(q, qd))


@LAWS
@given(SHARES, SHARES)
def test_three_terms(place, pace):
    q, qd = LOW + (HIGH - LOW) * place, LIMITS.velocity * (2 * pace - 1)
    gains = {"mu_p": 12.0, "mu_v": 9.0}
    low, high = numbers(acceleration_bounds, q, qd, range_share=0.1, **gains)
    theta = 0.1 * (LIMITS.upper - LIMITS.lower)
    w, a = LIMITS.velocity, LIMITS.acceleration
    with np.errstate(invalid="ignore"):
        up, down = 12 * (LIMITS.upper - theta - q), 12 * (LIMITS.lower + theta - q)
    up[1], down[1] = np.inf, -np.inf
    np.testing.assert_allclose(high, np.minimum.reduce([up, 9 * (w - qd), a]))
    np.testing.assert_allclose(low, np.maximum.reduce([down, 9 * (-w - qd), -a]))


@LAWS
@given(SHARES, SHARES)
def test_inside_the_margin_and_the_speeds_rest_is_allowed(place, pace):
    span = HIGH - LOW
    q = LOW + span * (0.02 + 0.96 * place)
    low, high = numbers(acceleration_bounds, q, LIMITS.velocity * (2 * pace - 1))
    assert np.all(low <= 1e-12)
    assert np.all(high >= -1e-12)


def safe_motion(place, pace):
    """A point of the set that braking_bounds promises to keep."""
    q, w = LOW + (HIGH - LOW) * place, LIMITS.velocity
    most, least = np.minimum(OMEGA * (HIGH - q), w), np.maximum(OMEGA * (LOW - q), -w)
    return q, least + (most - least) * pace


@LAWS
@given(SHARES, SHARES)
def test_braking_bounds_never_contradict_each_other_where_they_are_kept(place, pace):
    q, qd = safe_motion(place, pace)
    low, high = numbers(braking_bounds, q, qd)
    assert np.all(low <= high + 1e-9)
    finite = np.isfinite(LIMITS.upper)
    z = (OMEGA * (LIMITS.upper - q) - qd)[finite]
    rate = (-OMEGA * qd - high)[finite]  # of z, at the worst acceleration
    assert np.all(rate >= -OMEGA[finite] * z - 1e-9)


@pytest.mark.parametrize("side", [0, 1])
def test_the_worst_motion_within_braking_bounds_stays_inside(side):
    a, b = ca.SX.sym("q", 3), ca.SX.sym("qd", 3)
    f = ca.Function("f", [a, b], [*braking_bounds(a, b, LIMITS)])
    q, qd, h = np.array([0.5, 0.0, 0.3]), np.zeros(3), 2e-3
    for _ in range(6000):
        qdd = np.asarray(f(q, qd)[side]).ravel()
        q, qd = q + h * qd + h * h / 2 * qdd, qd + h * qdd
        assert np.all(np.abs(qd) <= LIMITS.velocity + 1e-6)
        assert np.all((q >= LIMITS.lower - 1e-6) & (q <= LIMITS.upper + 1e-6))
    end = LIMITS.upper if side else LIMITS.lower
    np.testing.assert_allclose(q[[0, 2]], end[[0, 2]], atol=1e-4)  # and it got there


@pytest.mark.parametrize("gains", [{"mu_p": 0.0}, {"mu_v": -1.0}, {"range_share": 0.5}])
def test_gains_of_the_three_terms(gains):
    with pytest.raises(RrnnError, match="acceleration bounds"):
        numbers(acceleration_bounds, np.zeros(3), np.zeros(3), **gains)


def test_the_speed_term_must_be_fast_enough():
    with pytest.raises(RrnnError, match="at least 3 1/s"):
        numbers(braking_bounds, np.zeros(3), np.zeros(3), mu_v=2.9)
