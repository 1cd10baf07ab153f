import casadi as ca
import numpy as np
import pytest

from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks import DualNetwork
from rrnn_opt.symbolic import Symbol
from tests.networks.toy import (
    BOUND,
    IDENTITY,
    LINEAR,
    WEIGHT,
    G,
    H,
    law,
    optimum,
    point,
    programme,
    values,
)


@pytest.mark.parametrize("weight", [IDENTITY, WEIGHT])
def test_the_equation_of_zhang_and_wang_by_hand(weight):
    """In u = (lambda, -mu, -z): eps u' = P(CM(C'u - q) - u) - CM(C'u - q)."""
    dynamics = DualNetwork(epsilon=0.2)(programme(weight))
    M, rng = np.linalg.inv(weight), np.random.default_rng(0)
    signs = np.array([1.0, 1.0, *(-1.0,) * 6])
    for seed in range(5):
        given, state = point(seed), rng.normal(size=8)
        C = np.vstack([given["A"], G, np.eye(4)])
        u = signs * state
        x = M @ (C.T @ u - LINEAR)
        low = np.concatenate([given["b"], np.full(2, -np.inf), np.full(4, -BOUND)])
        high = np.concatenate([given["b"], H, np.full(4, BOUND)])
        rate = (np.clip(C @ x - u, low, high) - C @ x) / 0.2
        got = law(dynamics, state, given)
        np.testing.assert_allclose(got, signs * rate, atol=1e-11)
        np.testing.assert_allclose(values(dynamics, "output", state, given), x)


def test_at_rest_its_neurons_are_the_solvers_multipliers():
    form = programme()
    dynamics = DualNetwork()(form)
    for seed in range(6):
        given = point(seed)
        best = optimum(form, given)
        if best is None:
            continue
        state = np.concatenate([-best.y, best.z, best.z_box])
        residual = values(dynamics, "residual", state, given)
        assert np.abs(residual).max() < 1e-8


@pytest.mark.parametrize("whiten", [False, True])
def test_no_mode_grows_within_the_bound_and_one_does_beyond_it(whiten):
    form = programme()
    rule = DualNetwork(epsilon=0.1, whiten=whiten)
    dynamics = rule(form)
    slope = ca.Function(
        "slope",
        [dynamics.state.sx, *(p.sx for p in form.parameters)],
        [ca.jacobian(dynamics.derivative, dynamics.state.sx)],
    )
    rng, largest = np.random.default_rng(0), 0.0
    for seed in range(40):
        given = point(seed)
        h = rule.euler_bound(form, **given)
        state = rng.normal(size=8) * rng.choice([0.1, 1.0, 10.0])
        modes = np.linalg.eigvals(np.asarray(slope(state, given["A"], given["b"])))
        growth = np.abs(1.0 + h * modes).max()
        assert growth <= 1.0 + 1e-9
        largest = max(largest, np.abs(1.0 + 1.3 * h * modes).max())
    assert largest > 1.0


def test_it_needs_no_inverse_for_the_identity_only():
    assert DualNetwork().needs(programme(IDENTITY)).inverse == "none"
    assert DualNetwork().needs(programme(WEIGHT)).inverse == "constant P inverse"
    both = DualNetwork(whiten=True).needs(programme(WEIGHT))
    assert both.inverse == "constant P inverse and Cholesky of A A'"
    assert both.duals == both.state == 8
    bare = programme(bounds=False, inequalities=False)
    assert DualNetwork().needs(bare).duals == 2


def test_a_singular_hessian_is_refused():
    with pytest.raises(RrnnError, match=r"DualNetwork: toy .* not positive definite"):
        DualNetwork()(programme(np.diag([1.0, 1.0, 1.0, 0.0])))


def test_without_rows_and_bounds_the_optimum_is_read_off():
    u = Symbol.vector("u", 2)
    form = Formulation("bare", u, (), cost=ca.sumsqr(u.sx - 1))
    dynamics = DualNetwork()(form)
    assert dynamics.duals() == {}
    output = values(dynamics, "output", np.zeros(2), {})
    np.testing.assert_allclose(output, [1.0, 1.0])
