import casadi as ca
import numpy as np
import pytest

from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks import LviPdnn
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
def test_the_equation_by_hand(weight):
    dynamics = LviPdnn(gamma=3.0)(programme(weight))
    rng = np.random.default_rng(0)
    for seed in range(5):
        given, y = point(seed), rng.normal(size=8)
        error, _ = hand_error(weight, given, y)
        turned = (np.eye(8) + hand_matrix(weight, given["A"]).T) @ error
        np.testing.assert_allclose(law(dynamics, y, given), -3.0 * turned, atol=1e-12)


@pytest.mark.parametrize("whiten", [False, True])
def test_no_step_within_the_bound_goes_away_from_the_solution(whiten):
    form, rule = programme(), LviPdnn(gamma=5.0)
    rng = np.random.default_rng(1)
    for seed in range(20):
        given = point(seed)
        best = optimum(form, given)
        if best is None:
            continue
        rest = np.concatenate([best.x, -best.y, best.z])
        h = rule.euler_bound(form, **given)
        for size in (0.1, 1.0, 10.0):
            y = rest + size * rng.normal(size=8)
            after = y + h * law(rule(form), y, given)
            assert np.linalg.norm(after - rest) <= np.linalg.norm(y - rest) + 1e-9


def test_the_bound_for_orthonormal_rows_is_the_one_told():
    u = Symbol.vector("u", 3)
    form = Formulation("rows", u, (), cost=ca.sumsqr(u.sx) / 2, equalities=u.sx[:2])
    told = 4.0 / (7.0 + np.sqrt(13.0))  # 2 / |I + H|^2 on each pair (u, lambda)
    assert LviPdnn(gamma=1.0).euler_bound(form) == pytest.approx(told)
    assert f"{told:.2f}/gamma" in (LviPdnn.euler_bound.__doc__ or "")


def test_a_semidefinite_hessian_settles_where_the_simplified_one_circles():
    """P = 0 with one row, u = 1: (6) has undamped modes, this one has none."""
    v = Symbol.scalar("v")
    form = Formulation("flat", v, (), cost=ca.SX(0), equalities=1 - v.sx)
    dynamics = LviPdnn(gamma=2.0)(form)
    slope = ca.jacobian(dynamics.derivative, dynamics.state.sx)
    modes = np.linalg.eigvals(np.asarray(ca.DM(ca.densify(slope))))
    np.testing.assert_allclose(modes.real, -2.0, atol=1e-12)


def test_hyper_parameters_are_positive():
    with pytest.raises(RrnnError, match="gamma"):
        LviPdnn(gamma=0.0)
    with pytest.raises(RrnnError, match="delta"):
        LviPdnn(delta=float("inf"))
