"""Scaled programmes beside DAQP: solved in v, judged in x."""

import numpy as np
import pytest
import qpsolvers

from rrnn_opt.errors import NotAQpError, NotFiniteError
from rrnn_opt.solving.parts import Dense
from rrnn_opt.solving.scaling import PROXIMAL, Scaled

TIGHT = {"primal_tol": 1e-12, "dual_tol": 1e-12}


def programme(seed, *, n=5, rows=4, equal=2, bounds=True):
    """A programme with a well definite P and an inner point at 0."""
    rng = np.random.default_rng(seed)
    root, G = rng.normal(size=(n, n)), rng.normal(size=(rows, n))
    A = rng.normal(size=(equal, n))
    wide = np.full(n, np.inf)
    sides = rng.uniform(0.1, 0.6, (2, n)) if bounds else (wide, wide)
    return Dense(
        root @ root.T + np.eye(n), 5 * rng.normal(size=n), G, rng.uniform(0.1, 1, rows),
        A, np.zeros(equal), -sides[0], sides[1],
    )  # fmt: skip


def solved(scaled):
    """(v, lambda, mu) by DAQP; the network's lambda has the opposite sign."""
    n, r, m = scaled.sizes
    parts = [scaled.values.get(k) for k in ("G", "h", "A", "b")]
    qp = qpsolvers.Problem(np.eye(n), scaled.values["cost"], *parts)
    answer = qpsolvers.solve_problem(qp, solver="daqp", **TIGHT)
    assert answer.found
    y, z = -np.resize(answer.y, r), np.resize(answer.z, m)
    return np.concatenate([answer.x, y if r else [], z if m else []])


@pytest.mark.parametrize("seed", range(8))
@pytest.mark.parametrize(
    "shape",
    [{}, {"rows": 0}, {"equal": 0}, {"bounds": False}, {"rows": 0, "equal": 0}],
)
def test_the_optimum_and_its_multipliers_come_back_to_the_programme_as_given(
    seed, shape
):
    """P x + q + A'y + G'z + z_box = 0 with all signs and complements right."""
    qp = programme(seed, **shape)
    scaled = Scaled.of(qp)
    x, duals = scaled.given(solved(scaled))
    gradient = qp.P @ x + qp.q + qp.A.T @ duals.y + qp.G.T @ duals.z + duals.z_box
    np.testing.assert_allclose(gradient, 0.0, atol=1e-7)
    np.testing.assert_allclose(qp.A @ x, qp.b, atol=1e-8)
    assert np.all(qp.G @ x <= qp.h + 1e-8)
    assert np.all((qp.lb - 1e-8 <= x) & (x <= qp.ub + 1e-8))
    assert np.all(duals.z >= 0.0)
    np.testing.assert_allclose(duals.z * (qp.h - qp.G @ x), 0.0, atol=1e-6)
    for side, sign in ((qp.ub, 1.0), (qp.lb, -1.0)):
        pressing = sign * duals.z_box > 1e-7
        np.testing.assert_allclose(x[pressing], side[pressing], atol=1e-7)


@pytest.mark.parametrize("seed", range(5))
def test_rows_have_length_one_and_the_hessian_is_the_identity(seed):
    qp = programme(seed)
    scaled = Scaled.of(qp)
    assert (scaled.rho, scaled.sizes) == (0.0, (5, 2, 14))
    A, G = scaled.values["A"], scaled.values["G"]
    np.testing.assert_allclose(scaled.back.T @ qp.P @ scaled.back, np.eye(5), atol=1e-9)
    np.testing.assert_allclose(A @ A.T, np.eye(2), atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(G, axis=1), 1.0, atol=1e-12)
    once = np.vstack([A, G[:9]])  # rows, upper bounds; lower ones are opposite
    assert scaled.sigma == pytest.approx(np.linalg.svd(once)[1][0], rel=1e-12)


def test_a_dependent_row_is_left_out_and_nothing_is_lost():
    qp = programme(3)
    twice = Dense(
        qp.P, qp.q, qp.G, qp.h, np.vstack([qp.A, qp.A.sum(axis=0)]),
        np.append(qp.b, qp.b.sum()), qp.lb, qp.ub,
    )  # fmt: skip
    scaled, once = Scaled.of(twice), Scaled.of(qp)
    assert scaled.sizes == once.sizes
    x, duals = scaled.given(solved(scaled))
    np.testing.assert_allclose(x, once.given(solved(once))[0], atol=1e-9)
    assert duals.y.shape == (3,)


def test_a_side_that_is_not_there_never_presses():
    """Its row is 0 v <= 1, whatever v is, and the other side still counts."""
    qp = programme(1, rows=1, equal=0)
    open_ended = Dense(
        qp.P, qp.q, qp.G, np.array([np.inf]), qp.A, qp.b, qp.lb, np.full(5, np.inf)
    )
    scaled = Scaled.of(open_ended)
    G, h = scaled.values["G"], scaled.values["h"]
    np.testing.assert_array_equal(G[:6], 0.0)
    np.testing.assert_array_equal(h[:6], 1.0)
    np.testing.assert_allclose(np.linalg.norm(G[6:], axis=1), 1.0)
    lower = np.vstack([G[6:]])
    assert scaled.sigma == pytest.approx(np.linalg.svd(lower)[1][0], rel=1e-12)


@pytest.mark.parametrize(
    ("P", "rho"),
    [(np.diag([4.0, 1.0]), 0.0), (np.diag([4.0, 0.0]), 4 * PROXIMAL),
     (np.zeros((2, 2)), 1.0), (np.diag([1.0, 1e-9]), PROXIMAL)],
)  # fmt: skip
def test_the_proximal_term_comes_where_p_is_nearly_singular(P, rho):
    """And its gradient at v cancels the rho that was added to P."""
    q, none = np.array([1.0, -2.0]), np.zeros((0, 2))
    wide = np.full(2, np.inf)
    scaled = Scaled.of(Dense(P, q, none, np.zeros(0), none, np.zeros(0), -wide, wide))
    assert scaled.rho == pytest.approx(rho)
    v = np.array([0.3, -0.7])
    gradient = v + scaled.cost_near(v)  # of 1/2 v'v + cost_near(v)'v, at v
    np.testing.assert_allclose(gradient, scaled.back.T @ (P @ scaled.back @ v + q))


def test_what_is_no_convex_programme_is_refused():
    qp = programme(0)
    parts = [qp.P, qp.q, qp.G, qp.h, qp.A, qp.b, qp.lb, qp.ub]
    with pytest.raises(NotAQpError, match="indefinite"):
        Scaled.of(Dense(-qp.P, *parts[1:]))
    for k, name in enumerate(["P", "q", "G", "h", "A", "b", "lb", "ub"]):
        spoilt = [part.copy() for part in parts]
        spoilt[k].flat[0] = np.nan
        with pytest.raises(NotFiniteError, match=name):
            Scaled.of(Dense(*spoilt))
