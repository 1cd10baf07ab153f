import numpy as np
import pytest

from rrnn_opt.errors import RrnnError
from rrnn_opt.networks import VaryingGainZnn
from tests.networks.moving import equations, error_rate
from tests.networks.toy import law, point, values


@pytest.mark.parametrize(("gain", "used"), [(7.0, 7.0), (60.0, 50.0)])
def test_the_gain_of_the_error_law_is_the_state_up_to_the_cap(gain, used):
    rule = VaryingGainZnn(gamma=5.0, growth=3.0, cap=50.0)
    dynamics, rng = rule(equations()), np.random.default_rng(0)
    for seed in range(6):
        state = np.append(rng.normal(size=6), gain)
        rate, now = error_rate(dynamics, seed, state)
        np.testing.assert_allclose(rate, -used * now, rtol=1e-5, atol=1e-6)


def test_the_gain_grows_exponentially_and_stops():
    rule = VaryingGainZnn(gamma=5.0, growth=3.0, cap=50.0)
    dynamics, given, h = rule(equations()).frozen, point(0), 1e-4
    state = np.append(np.zeros(6), 5.0)
    for k in range(9000):
        if k in (2000, 6000):
            assert state[6] == pytest.approx(5.0 * np.exp(3.0 * k * h), rel=1e-3)
        state = state + h * law(dynamics, state, given)
    assert 50.0 <= state[6] < 50.0 * (1 + 3.0 * h)
    assert np.abs(law(dynamics, state, given)).max() < 1e-6
    assert np.abs(values(dynamics, "residual", state, given)).max() < 1e-6


def test_a_run_starts_with_the_small_gain_and_steps_for_the_large_one():
    rule = VaryingGainZnn(gamma=5.0, cap=50.0)
    dynamics = rule(equations())
    assert float(dynamics.start[6]) == 5.0
    assert dynamics.longest_step == pytest.approx(1 / 50.0)
    assert rule.euler_bound(equations()) == pytest.approx(2 / 50.0)


def test_the_cap_is_above_the_start():
    with pytest.raises(RrnnError, match="not above gamma"):
        VaryingGainZnn(gamma=10.0, cap=10.0)
