import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.errors import RrnnError
from rrnn_opt.networks import FiniteTimeZnn, NoiseTolerantZnn, VaryingGainZnn, Znn
from tests.networks.moving import (
    equations,
    error,
    error_rate,
    moved,
    rates_of,
    told,
)
from tests.networks.toy import law, point, programme

FAMILY = [Znn, NoiseTolerantZnn, FiniteTimeZnn, VaryingGainZnn]


def test_the_error_fades_at_its_rate_while_the_data_move():
    dynamics, rng = Znn(gamma=7.0)(equations()), np.random.default_rng(0)
    for seed in range(6):
        rate, now = error_rate(dynamics, seed, rng.normal(size=6))
        np.testing.assert_allclose(rate, -7.0 * now, rtol=1e-6, atol=1e-6)


def follow(dynamics, given, rates, *, h=1e-4, steps=3000):
    """Euler along moving data; the error at the end."""
    state = np.zeros(6)
    for k in range(steps):
        here = moved(given, rates, k * h)
        state = state + h * law(dynamics, state, told(here, rates))
    return error(moved(given, rates, steps * h), state)


def test_told_the_rates_it_follows_without_the_lag_it_has_when_not_told():
    dynamics, given, rates = Znn(gamma=50.0)(equations()), point(1), rates_of(1)
    still = {name: np.zeros_like(value) for name, value in rates.items()}
    # the data move, the network believes that they stand still
    state, h = np.zeros(6), 1e-4
    for k in range(3000):
        here = moved(given, rates, k * h)
        state = state + h * law(dynamics, state, told(here, still))
    lag = np.abs(error(moved(given, rates, 3000 * h), state)).max()
    followed = np.abs(follow(dynamics, given, rates)).max()
    assert lag > 0.01
    assert followed < 0.01 * lag


@pytest.mark.parametrize("rule", FAMILY)
def test_what_it_cannot_solve_is_refused_by_name(rule):
    name = rule.__name__
    with pytest.raises(RrnnError, match=f"{name}: toy has inequality rows"):
        rule()(programme(bounds=False))
    with pytest.raises(RrnnError, match=f"{name}: toy has bounds on the decision"):
        rule()(programme(inequalities=False))
    flat = programme(np.diag([1.0, 1.0, 1.0, 0.0]), inequalities=False, bounds=False)
    with pytest.raises(RrnnError, match=rf"{name}: toy .* not positive definite"):
        rule()(flat)


@pytest.mark.parametrize("rule", FAMILY)
def test_it_says_that_it_solves_equations_in_every_step(rule):
    form = equations()
    needs = rule().needs(form)
    assert needs.inverse == "KKT solve"
    assert needs.rates
    assert needs.duals == 2
    assert needs.state == rule()(form).state.size
    assert {"div", "sqrt"} <= rule().operations


@pytest.mark.parametrize("rule", FAMILY)
def test_its_parameters_are_the_data_then_their_rates(rule):
    dynamics = rule()(equations())
    assert [p.name for p in dynamics.parameters] == ["A", "b", "A_rate", "b_rate"]
    assert {k: s.name for k, s in dynamics.rates.items()} == {
        "A": "A_rate",
        "b": "b_rate",
    }
    assert [p.name for p in dynamics.frozen.parameters] == ["A", "b"]


@pytest.mark.parametrize("rule", FAMILY)
def test_dependent_rows_divide_nothing_by_zero(rule):
    """Two equal rows: u is the optimum, the multipliers share the load."""
    form, row = equations(), np.array([1.0, -0.5, 0.2, 0.4])
    given = {"A": np.vstack([row, row]), "b": np.array([0.2, 0.2])}
    one = {"A": np.vstack([row, np.zeros(4)]), "b": np.array([0.2, 0.0])}
    x, info = rr.settle(rule()(form), tolerance=1e-7, **given)
    y, _ = rr.settle(rule()(form), tolerance=1e-7, **one)
    assert x is not None
    assert info.kkt_residual <= 1e-7
    np.testing.assert_allclose(x, y, atol=1e-6)


@pytest.mark.parametrize("rule", FAMILY)
def test_hyper_parameters_are_positive(rule):
    with pytest.raises(RrnnError, match="gamma"):
        rule(gamma=0.0)
    with pytest.raises(RrnnError, match="damping"):
        rule(damping=0.0)


def test_the_bound_is_that_of_its_one_mode():
    dynamics, given = Znn(gamma=10.0)(equations()).frozen, point(2)
    bound = Znn(gamma=10.0).euler_bound(equations(), **given)
    assert bound == pytest.approx(0.2)
    rest = np.linalg.norm(error(given, np.zeros(6)))
    for factor, shrinks in ((0.95, True), (1.05, False)):
        state = np.zeros(6)
        for _ in range(20):
            state = state + factor * bound * law(dynamics, state, given)
        assert bool(np.linalg.norm(error(given, state)) < rest) is shrinks
