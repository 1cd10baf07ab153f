import numpy as np
import pytest

from rrnn_opt.solving import Duals
from rrnn_opt.solving.parts import Dense
from rrnn_opt.validation.studies.agreement import (
    answer_of,
    conditioning,
    dual_distance,
    is_right,
    primal_distance,
    truth,
)


def programme(*, rows=((1.0, 1.0, 0.0),), sides=(1.0,), P=None, ub=0.3):
    """Least norm on a plane with x_0 <= ub active: x = (0.3, 0.7, 0)."""
    A = np.array(rows)
    return Dense(
        P=np.eye(3) if P is None else P,
        q=np.zeros(3),
        G=np.zeros((1, 3)),
        h=np.ones(1),
        A=A,
        b=np.array(sides),
        lb=np.full(3, -np.inf),
        ub=np.array([ub, np.inf, np.inf]),
    )


def optimum(qp, *, shift=0.0, dual_shift=0.0):
    """Its answer, moved away by as much as asked."""
    x = np.array([0.3, 0.7 + shift, 0.0])
    y = np.zeros(len(qp.b))
    y[0] = -0.7 + dual_shift
    return answer_of(qp, x, Duals(y, np.zeros(1), np.array([0.4, 0.0, 0.0])))


def test_the_truth_is_found_from_a_rough_answer():
    qp = programme()
    rough = optimum(qp, shift=1e-4, dual_shift=1e-4)
    exact = truth(qp, [rough])
    np.testing.assert_allclose(exact.x, [0.3, 0.7, 0.0], atol=1e-14)
    np.testing.assert_allclose(exact.duals.y, [-0.7], atol=1e-14)
    np.testing.assert_allclose(exact.duals.z_box, [0.4, 0.0, 0.0], atol=1e-14)
    assert exact.residual < 1e-14
    assert rough.residual > 1e-5


def test_there_is_no_truth_without_a_kkt_point():
    qp = programme()
    wrong = answer_of(qp, np.zeros(3), Duals(np.zeros(1), np.zeros(1), np.zeros(3)))
    assert truth(qp, [wrong]) is None
    assert truth(qp, []) is None


@pytest.mark.parametrize(
    ("shifts", "right"),
    [
        ({}, True),
        ({"shift": 5e-7}, True),
        ({"shift": 2e-6}, False),
        ({"dual_shift": 5e-7}, True),
        ({"dual_shift": 1e-5}, False),
    ],
)
def test_right_is_within_the_tolerance_of_the_truth(shifts, right):
    qp = programme()
    exact = truth(qp, [optimum(qp)])
    known = conditioning(qp, exact.x)
    assert known.primal
    assert known.dual
    assert is_right(optimum(qp, **shifts), exact, known) is right


def test_dependent_rows_leave_the_multipliers_open():
    qp = programme(rows=((1.0, 1.0, 0.0), (2.0, 2.0, 0.0)), sides=(1.0, 2.0))
    known = conditioning(qp, np.array([0.3, 0.7, 0.0]))
    assert known.primal
    assert not known.dual
    other = answer_of(
        qp,
        np.array([0.3, 0.7, 0.0]),
        Duals(np.array([0.3, -0.5]), np.zeros(1), np.array([0.4, 0.0, 0.0])),
    )
    exact = truth(qp, [other])
    assert dual_distance(optimum(qp), exact) > 1e-3
    assert is_right(optimum(qp), exact, known)


def test_a_row_that_is_zero_has_no_multiplier_and_costs_no_condition():
    qp = programme(rows=((1.0, 1.0, 0.0), (0.0, 0.0, 0.0)), sides=(1.0, 0.0))
    known = conditioning(qp, np.array([0.3, 0.7, 0.0]))
    assert known.primal
    assert known.dual
    duals = Duals(np.array([-0.7, 99.0]), np.zeros(1), np.array([0.4, 0.0, 0.0]))
    answer = answer_of(qp, np.array([0.3, 0.7, 0.0]), duals)
    assert answer.duals.y[1] == 0.0
    assert dual_distance(answer, optimum(qp)) < 1e-12


def test_nearly_dependent_rows_and_flat_costs_are_not_well():
    slanted = ((1.0, 1.0, 0.0), (1.0, 1.0 + 1e-6, 0.0))
    x = np.array([0.3, 0.7, 0.0])
    assert not conditioning(programme(rows=slanted, sides=(1.0, 1.0), ub=5.0), x).primal
    assert not conditioning(programme(P=np.diag([1.0, 1.0, 0.0])), x).primal


def test_elsewhere_the_kkt_residual_decides():
    qp = programme(P=np.diag([1.0, 1.0, 0.0]))
    known = conditioning(qp, np.array([0.3, 0.7, 0.0]))
    elsewhere = optimum(qp)
    elsewhere = answer_of(qp, elsewhere.x + np.array([0.0, 0.0, 5.0]), elsewhere.duals)
    assert primal_distance(elsewhere, optimum(qp)) == 5.0
    exact = truth(qp, [optimum(qp)])
    assert is_right(elsewhere, exact, known)
    assert not is_right(optimum(qp, shift=1e-4), exact, known)
