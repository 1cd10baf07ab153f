import numpy as np
import pytest

from rrnn_opt.networks import E47
from tests.networks.toy import (
    BOUND,
    IDENTITY,
    WEIGHT,
    hand_error,
    hand_matrix,
    law,
    optimum,
    point,
    programme,
)


@pytest.mark.parametrize("weight", [IDENTITY, WEIGHT])
def test_the_iteration_by_hand(weight):
    dynamics = E47()(programme(weight))
    rng = np.random.default_rng(0)
    for seed in range(5):
        given, y = point(seed), rng.normal(size=8)
        error, F = hand_error(weight, given, y)
        back = hand_matrix(weight, given["A"]).T @ error
        rho = error @ error / ((error + back) @ (error + back))
        wanted = y - rho * (back + F)
        wanted[:4] = np.clip(wanted[:4], -BOUND, BOUND)
        wanted[6:] = np.maximum(wanted[6:], 0.0)
        np.testing.assert_allclose(law(dynamics, y, given), wanted, atol=1e-12)


def test_it_comes_to_rest_at_the_solvers_optimum():
    form = programme()
    dynamics = E47()(form)
    for seed in range(3):
        given = point(seed)
        best = optimum(form, given)
        y = np.zeros(8)
        for _ in range(600):
            y = law(dynamics, y, given)
            assert np.abs(y[:4]).max() <= BOUND
        np.testing.assert_allclose(y[:4], best.x, atol=1e-6)
