import casadi as ca
import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.networks import (
    E47,
    DualNetwork,
    Hildreth,
    Lvi94,
    LviPdnn,
    PrimalDual,
    SimplifiedLviPdnn,
)
from rrnn_opt.networks.whitening import Whitened
from tests.networks.toy import optimum, point, programme

RULES = [PrimalDual, SimplifiedLviPdnn, LviPdnn, Lvi94, E47, DualNetwork, Hildreth]


def whitened_rows(form, given, delta):
    white = Whitened.of(form, delta)
    problem = white.form.qp.at(**given)
    return problem.A, problem.b


@pytest.mark.parametrize("delta", [1e-9, 1e-6, 1.0])
def test_the_rows_by_hand(delta):
    form, given = programme(), point(3)
    A, b = given["A"], given["b"]
    L = np.linalg.cholesky(A @ A.T + delta * np.eye(2))
    got_A, got_b = whitened_rows(form, given, delta)
    np.testing.assert_allclose(got_A, np.linalg.solve(L, A), atol=1e-9)
    np.testing.assert_allclose(got_b, np.linalg.solve(L, b), atol=1e-9)
    sigma = np.linalg.svd(A, compute_uv=False)
    shrunk = sigma / np.sqrt(sigma**2 + delta)
    np.testing.assert_allclose(np.linalg.svd(got_A, compute_uv=False), shrunk)


def test_dependent_rows_keep_their_solutions():
    """Rank one: u is feasible for the whitened rows exactly when it was."""
    form = programme()
    row = np.array([1.0, 2.0, -1.0, 0.5])
    given = {"A": np.vstack([row, 2 * row]), "b": np.array([0.3, 0.6])}
    A, b = whitened_rows(form, given, 1e-6)
    kernel = np.linalg.svd(row[None])[2][1:]
    inside = 0.3 * row / (row @ row)
    for step in (np.zeros(3), np.array([0.3, -2.0, 0.7])):
        np.testing.assert_allclose(A @ (inside + kernel.T @ step), b, atol=1e-9)
    assert np.abs(A @ (inside + 0.1 * row) - b).max() > 0.1


@pytest.mark.parametrize("rule", RULES)
def test_multipliers_are_those_of_the_rows_as_declared(rule):
    form = programme()
    dynamics = rule(whiten=True)(form)
    assert dynamics.formulation is form
    checked = 0
    for seed in range(5):
        given = point(seed)
        best = optimum(form, given)
        if best is None:
            continue
        x, info = rr.settle(dynamics, **given)
        np.testing.assert_allclose(x, best.x, atol=1e-6)
        np.testing.assert_allclose(info.duals["equality"], -best.y, atol=1e-5)
        np.testing.assert_allclose(info.duals["inequality"], best.z, atol=1e-5)
        np.testing.assert_allclose(info.duals["box"], best.z_box, atol=1e-5)
        checked += 1
    assert checked >= 3


@pytest.mark.parametrize("rule", RULES)
def test_it_is_off_unless_asked_for_and_declared_when_on(rule):
    form = programme(np.eye(4))
    assert not rule().whiten
    assert rule().needs(form).inverse == "none"
    assert rule(whiten=True).needs(form).inverse == "Cholesky of A A'"
    assert "sqrt" in rule(whiten=True).operations - rule().operations


def test_without_equality_rows_nothing_changes():
    u = rr.Symbol.vector("u", 2)
    form = rr.Formulation("box", u, (), cost=ca.sumsqr(u.sx - 1), upper=ca.SX([0.5, 2]))
    plain, white = LviPdnn()(form), LviPdnn(whiten=True)(form)
    assert white.formulation is form
    assert ca.is_equal(plain.derivative, white.derivative, 5)
    assert LviPdnn(whiten=True).needs(form).inverse == "none"


def test_it_settles_in_far_fewer_steps():
    """The PA10 in a posture with a small singular value."""
    kin = rr.Kinematics(rr.Robot.builtin("pa10"))
    form = rr.formulations.minimum_velocity(kin)
    q = np.deg2rad([20.0, 30.0, 10.0, 15.0, 0.0, 10.0, 0.0])
    given = {"q": q, "rd_dot": np.array([0.02, 0.03, 0.01])}
    counts = []
    for whiten in (False, True):
        x, info = rr.settle(LviPdnn(whiten=whiten)(form), newton=False, **given)
        assert x is not None
        counts.append(info.steps)
    assert counts[1] < counts[0] / 20
