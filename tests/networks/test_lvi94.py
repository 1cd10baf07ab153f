import casadi as ca
import numpy as np
import pytest

from rrnn_opt.formulation import Formulation
from rrnn_opt.networks import Lvi94
from rrnn_opt.symbolic import Symbol
from tests.networks.toy import (
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
    dynamics = Lvi94()(programme(weight))
    rng = np.random.default_rng(0)
    for seed in range(5):
        given, y = point(seed), rng.normal(size=8)
        error, _ = hand_error(weight, given, y)
        turned = (np.eye(8) + hand_matrix(weight, given["A"]).T) @ error
        rho = error @ error / (turned @ turned)
        np.testing.assert_allclose(
            law(dynamics, y, given), y - rho * turned, atol=1e-12
        )


def test_every_step_goes_nearer_and_a_solution_stays():
    form, rng = programme(), np.random.default_rng(1)
    dynamics = Lvi94()(form)
    checked = 0
    for seed in range(12):
        given = point(seed)
        best = optimum(form, given)
        if best is None:
            continue
        rest = np.concatenate([best.x, -best.y, best.z])
        np.testing.assert_allclose(law(dynamics, rest, given), rest, atol=1e-7)
        y = rest + rng.normal(size=8)
        for _ in range(5):
            after = law(dynamics, y, given)
            assert np.linalg.norm(after - rest) < np.linalg.norm(y - rest)
            y = after
        checked += 1
    assert checked >= 5


def test_an_exact_solution_is_no_division_by_zero():
    """u = 0 with c = 0, b = 0: the error is exactly zero."""
    u = Symbol.vector("u", 2)
    form = Formulation("still", u, (), cost=ca.sumsqr(u.sx), equalities=u.sx[0])
    after = law(Lvi94()(form), np.zeros(3), {})
    assert after[:3].tolist() == [0.0, 0.0, 0.0]


def test_a_map_has_no_step_bound():
    assert Lvi94().euler_bound(programme(), **point(0)) == float("inf")
