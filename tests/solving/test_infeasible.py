from fractions import Fraction

import numpy as np
import pytest
import qpsolvers
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.solving.infeasible import farkas_margin, find_farkas


def problem(seed: int, stretch: float) -> qpsolvers.Problem:
    """Rows met by a point of the box when stretch <= 1."""
    rng = np.random.default_rng(seed)
    n = 5
    A, G = rng.normal(size=(2, n)), rng.normal(size=(2, n))
    x = rng.uniform(-1, 1, n) * stretch
    return qpsolvers.Problem(
        np.eye(n), np.zeros(n), G, G @ x, A, A @ x, -np.ones(n), np.ones(n)
    )


@given(seed=st.integers(0, 10_000))
@settings(max_examples=30)
def test_a_feasible_problem_has_no_witness(seed):
    assert find_farkas(problem(seed, 1.0)) is None


@given(seed=st.integers(0, 10_000), data=st.data())
@settings(max_examples=30)
def test_no_multipliers_ever_refute_a_feasible_problem(seed, data):
    number = st.floats(-1, 1)
    y = np.array(data.draw(st.lists(number, min_size=2, max_size=2)))
    z = np.array(data.draw(st.lists(number, min_size=2, max_size=2)))
    assert farkas_margin(problem(seed, 1.0), y, z) <= 1e-12


@pytest.mark.parametrize("seed", range(5))
def test_a_witness_separates_every_point_of_the_box(seed):
    qp = problem(seed, 100.0)
    witness = find_farkas(qp)
    assert witness is not None
    points = np.random.default_rng(seed).uniform(-1, 1, (200, 5))
    values = points @ (qp.A.T @ witness.y + qp.G.T @ witness.z)
    values -= qp.b @ witness.y + qp.h @ witness.z
    assert values.min() >= witness.margin > 0.0


def test_crossed_bounds_are_infeasible():
    qp = qpsolvers.Problem(
        np.eye(1), np.zeros(1), lb=np.array([1.0]), ub=np.array([0.5])
    )
    assert find_farkas(qp).margin == 0.5


def test_contradicting_rows_without_bounds():
    A = np.array([[1.0, 2.0], [2.0, 4.0]])
    qp = qpsolvers.Problem(np.eye(2), np.zeros(2), A=A, b=np.array([1.0, 3.0]))
    assert find_farkas(qp).margin == pytest.approx(0.5)


def test_an_unbounded_coordinate_cannot_be_separated():
    G = np.array([[1.0, 1.0]])
    qp = qpsolvers.Problem(np.eye(2), np.zeros(2), G, np.array([-5.0]))
    assert farkas_margin(qp, np.zeros(0), np.ones(1)) == -np.inf
    assert find_farkas(qp) is None


def test_a_row_without_a_bound_refutes_nothing():
    G, lb = np.array([[1.0]]), np.array([0.0])
    qp = qpsolvers.Problem(np.eye(1), np.zeros(1), G, np.array([np.inf]), lb=lb)
    assert find_farkas(qp) is None


@given(seed=st.integers(0, 10_000), power=st.integers(0, 12))
@settings(max_examples=30)
def test_a_margin_is_never_more_than_the_exact_one(seed, power):
    """Against the same minimum in rational numbers."""
    qp = problem(seed, 10.0**power)
    rng = np.random.default_rng(seed + 1)
    y, z = rng.uniform(-1, 1, 2), rng.uniform(0, 1, 2)

    def exact(values):
        return [Fraction(float(v)) for v in values]

    rows = [exact(line) for line in np.vstack([qp.A, qp.G])]
    weights, sides = exact([*y, *z]), exact([*qp.b, *qp.h])
    margin = -sum(w * side for w, side in zip(weights, sides, strict=True))
    for j, ends in enumerate(zip(exact(qp.lb), exact(qp.ub), strict=True)):
        entry = sum(w * row[j] for w, row in zip(weights, rows, strict=True))
        margin += min(entry * end for end in ends)
    found = farkas_margin(qp, y, z)
    assert Fraction(found) <= margin
    assert found == pytest.approx(float(margin), rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("part", ["A", "b", "G"])
def test_nothing_is_shown_of_rows_that_hold_nan(part):
    qp = problem(0, 100.0)
    number = getattr(qp, part)
    number[(0,) * number.ndim] = np.nan
    assert find_farkas(qp) is None
