import math

import numpy as np
import pytest
import qpsolvers
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.solving.parts import OSQP_JUNK, Dense, Duals
from rrnn_opt.solving.residual import NOT_JUDGED, judge, kkt_residual
from rrnn_opt.solving.status import Status


def optimal_qp(seed: int) -> tuple[qpsolvers.Problem, np.ndarray, Duals]:
    """A QP built around a chosen optimum, so that no solver is asked."""
    rng = np.random.default_rng(seed)
    n, meq, mineq = 6, 2, 3
    root = rng.normal(size=(n, n))
    x = rng.uniform(-1, 1, n)
    A, G = rng.normal(size=(meq, n)), rng.normal(size=(mineq, n))
    y, z = rng.normal(size=meq), np.array([0.7, 0.0, 0.3])
    z_box = np.zeros(n)
    lb, ub = x - rng.uniform(0.1, 1, n), x + rng.uniform(0.1, 1, n)
    z_box[0], ub[0] = 0.4, x[0]
    z_box[1], lb[1] = -0.6, x[1]
    lb[2], ub[3] = -np.inf, np.inf
    h = G @ x + np.where(z > 0, 0.0, 0.5)
    P = root @ root.T
    q = -(P @ x + A.T @ y + G.T @ z + z_box)
    problem = qpsolvers.Problem(P, q, G, h, A, A @ x, lb, ub)
    return problem, x, Duals(y, z, z_box)


@given(seed=st.integers(0, 10_000))
@settings(max_examples=50)
def test_a_constructed_optimum_has_no_residual(seed):
    problem, x, duals = optimal_qp(seed)
    assert kkt_residual(problem, x, duals).worst < 1e-12
    assert judge(problem, x, duals, tolerance=1e-10)[0] is Status.SOLVED


@given(seed=st.integers(0, 10_000))
@settings(max_examples=30)
def test_the_residuals_are_those_that_qpsolvers_computes(seed):
    problem, x, duals = optimal_qp(seed)
    x = x + np.random.default_rng(seed).normal(size=x.size) * 0.1
    oracle = qpsolvers.Solution(problem)
    oracle.found, oracle.x = True, x
    oracle.y, oracle.z, oracle.z_box = duals.y, duals.z, duals.z_box
    ours = kkt_residual(problem, x, duals)
    assert ours.primal == pytest.approx(oracle.primal_residual(), rel=1e-9)
    assert ours.dual == pytest.approx(oracle.dual_residual(), rel=1e-9)
    assert ours.gap == pytest.approx(oracle.duality_gap(), rel=1e-9)


def one_variable(lb=0.0, ub=1.0, q=0.0, G=None, h=None):
    return qpsolvers.Problem(
        np.eye(1), np.array([q]), G, h, lb=np.array([lb]), ub=np.array([ub])
    )


def duals_1(z_box=0.0, z=None):
    return Duals(np.zeros(0), np.zeros(0) if z is None else z, np.array([z_box]))


def test_each_part_is_measured_alone():
    at_top = one_variable(q=-3.0)
    assert kkt_residual(at_top, [1.0], duals_1(2.0)).worst == 0.0
    assert kkt_residual(at_top, [1.25], duals_1(1.75)).primal == 0.25
    assert kkt_residual(at_top, [1.0], duals_1(1.5)).dual == 0.5
    inside = kkt_residual(at_top, [0.5], duals_1(2.5))
    assert inside.complementarity == 1.25
    assert inside.gap == 1.25
    assert inside.primal == 0.0 == inside.dual
    at_bottom = one_variable(q=3.0)
    assert kkt_residual(at_bottom, [0.0], duals_1(-3.0)).worst == 0.0
    assert kkt_residual(at_bottom, [-0.5], duals_1(-2.5)).primal == 0.5
    assert kkt_residual(at_bottom, [0.5], duals_1(-3.5)).complementarity == 1.75


def test_a_multiplier_of_the_wrong_sign_is_a_dual_residual():
    row = one_variable(G=np.array([[1.0]]), h=np.array([0.0]), q=1.0)
    wrong = kkt_residual(row, [0.0], duals_1(0.0, np.array([-1.0])))
    assert wrong.dual == 1.0


def test_a_multiplier_against_an_infinite_bound_is_a_dual_residual():
    free = one_variable(lb=-np.inf, ub=np.inf, q=-1.0)
    assert kkt_residual(free, [0.0], duals_1(1.0)).dual == 1.0
    assert kkt_residual(one_variable(-np.inf, q=1.0), [0.0], duals_1(-1.0)).dual == 1.0


@pytest.mark.parametrize(
    "x", [None, [math.nan], [math.inf], [OSQP_JUNK], [1.0, 2.0], [[0.0]]]
)
def test_junk_is_never_a_point(x):
    status, residual = judge(one_variable(), x, duals_1(), tolerance=1e6)
    assert status is Status.NUMERICAL
    assert residual == NOT_JUDGED


@pytest.mark.parametrize("junk", [math.nan, OSQP_JUNK, -math.inf])
def test_junk_multipliers_are_not_judged(junk):
    status, residual = judge(one_variable(), [0.0], duals_1(junk), tolerance=1e12)
    assert status is Status.NUMERICAL
    assert residual.primal == 0.0
    assert math.isinf(residual.dual)


def test_without_multipliers_nothing_is_solved():
    assert judge(one_variable(), [0.0], None, tolerance=1.0)[0] is Status.NUMERICAL


@pytest.mark.parametrize(
    ("miss", "status"),
    [
        (1e-9, Status.SOLVED),
        (1e-7, Status.SOLVED_INACCURATE),
        (1e-4, Status.NUMERICAL),
    ],
)
def test_the_status_follows_the_residual(miss, status):
    got, residual = judge(one_variable(), [-miss], duals_1(miss), tolerance=1e-8)
    assert got is status
    assert residual.worst == pytest.approx(miss, rel=1e-3)
    assert got.has_point == (status is not Status.NUMERICAL)


def test_absent_parts_become_empty_rows_and_infinite_bounds():
    dense = Dense.of(qpsolvers.Problem(np.eye(2), np.zeros(2)))
    assert dense.A.shape == (0, 2) == dense.G.shape
    assert np.isneginf(dense.lb).all()
    assert np.isposinf(dense.ub).all()
    assert Dense.of(dense) is dense


def test_every_status_says_a_sentence():
    assert all(" " in status.value for status in Status)
    assert Status.PRIMAL_INFEASIBLE.key == "primal_infeasible"


@pytest.mark.parametrize("part", ["P", "q", "G", "h", "A", "b", "lb", "ub"])
def test_a_programme_with_nan_is_never_solved(part):
    problem, x, duals = optimal_qp(0)
    number = getattr(problem, part)
    number[(0,) * number.ndim] = np.nan
    status, residual = judge(problem, x, duals, tolerance=1e-6)
    assert status is Status.NUMERICAL
    assert residual.worst == math.inf
    assert not math.isnan(residual.primal + residual.dual)
