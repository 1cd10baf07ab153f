import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.errors import RrnnError
from rrnn_opt.networks import FiniteTimeZnn
from tests.networks.moving import equations, error, error_rate
from tests.networks.toy import law, point


@pytest.mark.parametrize("power", [0.5, 0.25])
def test_the_error_law_is_sign_bi_power(power):
    rule = FiniteTimeZnn(gamma=7.0, power=power)
    dynamics, rng = rule(equations()), np.random.default_rng(0)
    for seed in range(6):
        rate, now = error_rate(dynamics, seed, rng.normal(size=6))
        both = np.abs(now) ** power + np.abs(now) ** (1 / power)
        wanted = -7.0 * np.sign(now) * both / 2
        np.testing.assert_allclose(rate, wanted, rtol=1e-6, atol=1e-6)


def test_it_is_at_rest_in_the_time_that_is_promised():
    rule, form = FiniteTimeZnn(gamma=100.0), equations()
    for seed in range(4):
        given = point(seed)
        largest = np.abs(error(given, np.zeros(6))).max()
        x, info = rr.settle(rule(form), newton=False, **given)
        assert x is not None
        time = info.steps * info.step
        assert time <= 2 * largest**0.5 / (100.0 * 0.5)
        # no linear law of this gain is that small by then
        assert np.exp(-100.0 * time) * largest > 10 * info.kkt_residual


def test_the_bound_is_the_step_of_the_allowed_flutter():
    rule = FiniteTimeZnn(gamma=100.0, band=1e-6)
    given, dynamics = point(1), rule(equations()).frozen
    h = rule.euler_bound(equations(), **given)
    assert h == pytest.approx(4e-3 / 100)
    assert dynamics.longest_step == h
    state, left = np.zeros(6), []
    for k in range(4000):
        state = state + h * law(dynamics, state, given)
        if k >= 3900:
            left.append(np.abs(error(given, state)).max())
    assert 1e-8 < max(left) < 3e-6


@pytest.mark.parametrize("power", [1.0, 1.5])
def test_the_power_is_below_one(power):
    with pytest.raises(RrnnError, match="below 1"):
        FiniteTimeZnn(power=power)
