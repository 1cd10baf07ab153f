import dataclasses

import casadi as ca
import numpy as np
import pytest
import qpsolvers
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.symbolic import Symbol

N, EQ, INEQ = 5, 2, 2
LAWS = settings(max_examples=30)
seeds = st.integers(0, 10**6)


def random_form(seed, *, identity=False):
    """A random strictly convex QP with an interior point, and that point."""
    rng = np.random.default_rng(seed)
    root = rng.integers(-2, 3, (N, N)).astype(float)
    W = np.eye(N) / 2 if identity else root @ root.T + np.eye(N)
    inside = rng.uniform(-0.5, 0.5, N)
    M, G = rng.normal(size=(EQ, N)), rng.normal(size=(INEQ, N))
    u, c = Symbol.vector("u", N), Symbol.vector("c", N)
    form = Formulation(
        name="random",
        decision=u,
        parameters=(c,),
        cost=ca.bilin(ca.SX(W), u.sx, u.sx) + ca.dot(c.sx, u.sx),
        equalities=M @ inside - ca.SX(M) @ u.sx,
        inequalities=ca.SX(G) @ u.sx - (G @ inside + rng.uniform(0.05, 0.5, INEQ)),
        lower=ca.SX(-np.ones(N)),
        upper=ca.SX(np.ones(N)),
    )
    return form, rng.normal(scale=5.0, size=N)


def solved(form, c):
    problem = form.qp.at(c=c)
    tight = {"primal_tol": 1e-11, "dual_tol": 1e-11}
    answer = qpsolvers.solve_problem(problem, solver="daqp", **tight)
    assert answer.found
    return answer


def evaluate(form, expr, u, lam, mu, c):
    law = form.lagrangian
    inputs = [s.sx for s in (*law.symbols, *form.parameters)]
    return np.asarray(ca.Function("f", inputs, [expr])(u, lam, mu, c)).ravel()


@LAWS
@given(seed=seeds)
def test_optimum_and_multipliers_are_an_equilibrium(seed):
    form, c = random_form(seed)
    best = solved(form, c)
    law = form.lagrangian
    residual = evaluate(form, law.residual, best.x, -best.y, best.z, c)
    np.testing.assert_allclose(residual, 0.0, atol=1e-8)
    z_box = evaluate(form, law.bound_dual, best.x, -best.y, best.z, c)
    np.testing.assert_allclose(z_box, best.z_box, atol=1e-8)


@LAWS
@given(seed=seeds)
def test_an_equilibrium_is_an_optimum(seed):
    # from the other side: choose an equilibrium, bounds and rows active at
    # random, and ask a solver
    rng = np.random.default_rng(seed)
    form, _ = random_form(seed)
    u = np.clip(rng.uniform(-1.6, 1.6, N), -1, 1)
    normal = np.where(np.abs(u) == 1, rng.uniform(0.1, 2, N) * u, 0.0)
    lam, mu = rng.normal(size=EQ), np.maximum(rng.normal(size=INEQ), 0)
    qp = form.qp
    A, G = (np.asarray(ca.DM(M)) for M in (qp.A, qp.G))
    c = A.T @ lam - G.T @ mu - qp.hessian @ u - normal
    slack = np.where(mu > 0, 0.0, rng.uniform(0.1, 1, INEQ))
    moved = dataclasses.replace(
        form,
        equalities=A @ u - ca.SX(A) @ form.decision.sx,
        inequalities=ca.SX(G) @ form.decision.sx - (G @ u + slack),
    )
    residual = evaluate(moved, moved.lagrangian.residual, u, lam, mu, c)
    np.testing.assert_allclose(residual, 0.0, atol=1e-12)
    best = solved(moved, c)
    np.testing.assert_allclose(best.x, u, atol=1e-7)


@LAWS
@given(seed=seeds)
def test_perturbed_points_are_no_equilibrium(seed):
    form, c = random_form(seed)
    best = solved(form, c)
    moved = 0.5 * best.x
    residual = evaluate(form, form.lagrangian.residual, moved, -best.y, best.z, c)
    if np.linalg.norm(moved - best.x) > 1e-6:
        assert np.abs(residual).max() > 1e-9


@pytest.mark.parametrize("identity", [True, False])
def test_gradient_residual_and_drive_follow_from_the_expression(identity):
    form, c = random_form(3, identity=identity)
    law, rng = form.lagrangian, np.random.default_rng(7)
    u, lam, mu = rng.normal(size=N), rng.normal(size=EQ), rng.uniform(size=INEQ)

    def at(expr):
        return evaluate(form, expr, u, lam, mu, c)

    symbols = [s.sx for s in law.symbols]
    gradient, e, g = (ca.gradient(law.expression, s) for s in symbols)
    np.testing.assert_allclose(at(law.gradient), at(gradient), rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(at(law.drive), u - at(gradient), rtol=1e-12, atol=1e-12)
    F = np.concatenate([at(gradient), -at(e), -at(g)])
    np.testing.assert_allclose(at(law.map), F, rtol=1e-12, atol=1e-12)
    z = np.concatenate([u, lam, mu])
    expected = at(law.set.project(law.point - law.map)) - z
    np.testing.assert_allclose(at(law.residual), expected, atol=1e-12)
    np.testing.assert_array_equal(at(e), at(form.equalities))
    np.testing.assert_array_equal(at(g), at(form.inequalities))


@LAWS
@given(seed=seeds)
def test_the_map_is_monotone(seed):
    form, c = random_form(seed)
    rng, law = np.random.default_rng(seed), form.lagrangian
    a, b = (rng.normal(size=N + EQ + INEQ) for _ in range(2))

    def F(z):
        return evaluate(form, law.map, *np.split(z, [N, N + EQ]), c)

    assert (a - b) @ (F(a) - F(b)) >= -1e-9


def test_no_u_minus_u_is_left_for_the_unit_hessian():
    form, _ = random_form(0, identity=True)
    assert not ca.depends_on(form.lagrangian.drive, form.decision.sx)


def test_the_multipliers_names_are_reserved():
    u, lam = Symbol.vector("u", 2), Symbol.vector("lam", 2)
    form = Formulation("t", u, (lam,), cost=ca.sumsqr(u.sx), equalities=u.sx - lam.sx)
    with pytest.raises(RrnnError, match="'lam'"):
        _ = form.lagrangian
