import numpy as np
import pytest

from rrnn_opt.networks import NoiseTolerantZnn, Znn
from tests.networks.moving import equations, error, error_rate, matrix
from tests.networks.toy import law, point


def test_the_error_law_has_the_integral_as_a_state_of_its_own():
    rule = NoiseTolerantZnn(gamma=7.0, integral=30.0)
    dynamics, rng = rule(equations()), np.random.default_rng(0)
    for seed in range(6):
        state = rng.normal(size=12)
        rate, now = error_rate(dynamics, seed, state)
        wanted = -7.0 * now - 30.0 * state[6:]
        np.testing.assert_allclose(rate, wanted, rtol=1e-6, atol=1e-6)


def disturbed(rule, size, noise, *, h=5e-4, steps=4000):
    """Run with a constant disturbance of the error's derivative."""
    given = point(3)
    dynamics = rule(equations()).frozen
    push = np.zeros(size)
    push[:6] = np.linalg.solve(matrix(given), noise)
    state = np.zeros(size)
    for _ in range(steps):
        state = state + h * (law(dynamics, state, given) + push)
    return error(given, state), state


def test_a_constant_disturbance_is_cancelled_where_znn_keeps_an_error():
    noise = np.array([0.5, -1.0, 0.3, 0.2, 0.7, -0.4])
    left, state = disturbed(NoiseTolerantZnn(50.0, 400.0), 12, noise)
    assert np.abs(left).max() < 1e-6
    np.testing.assert_allclose(state[6:], noise / 400.0, atol=1e-6)
    kept, _ = disturbed(Znn(50.0), 6, noise)
    np.testing.assert_allclose(kept, noise / 50.0, rtol=1e-5)


def test_the_memory_is_not_the_error_times_the_time():
    """After an error that came and went, the integral of it is left."""
    dynamics, given = NoiseTolerantZnn(50.0, 400.0)(equations()).frozen, point(3)
    state, h, total = np.zeros(12), 1e-4, np.zeros(6)
    for _ in range(200):
        total += h * error(given, state)
        state = state + h * law(dynamics, state, given)
    np.testing.assert_allclose(state[6:], total, atol=1e-12)
    assert np.abs(total).max() > 1e-3


@pytest.mark.parametrize(
    ("integral", "bound"), [(400.0, 2 / (25 + 15)), (2500.0, 0.02)]
)
def test_the_bound_is_that_of_its_two_modes(integral, bound):
    rule = NoiseTolerantZnn(gamma=50.0, integral=integral)
    assert rule.euler_bound(equations()) == pytest.approx(bound)
    modes = np.roots([1.0, 50.0, integral])
    assert np.abs(1 + 0.999 * bound * modes).max() < 1.0
    assert np.abs(1 + 1.001 * bound * modes).max() > 1.0
