import dataclasses
import subprocess
import sys

import casadi as ca
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.errors import (
    InfeasibleQpError,
    NotAQpError,
    NotFiniteError,
    RrnnError,
    ShapeError,
)
from rrnn_opt.formulation import Formulation
from rrnn_opt.symbolic import Symbol

u = Symbol.vector("u", 3)
J = Symbol.matrix("J", (2, 3))
v = Symbol.vector("v", 2)
w = Symbol.vector("w", 3)
GIVEN = {
    "J": np.array([[1.0, 2.0, -1.0], [0.5, 0.0, 3.0]]),
    "v": np.array([0.3, -0.2]),
    "w": np.array([1.0, 2.0, 3.0]),
}
W = np.array([[2.0, 0.5, 0.0], [0.5, 1.0, 0.25], [0.0, 0.25, 3.0]])


def declared(**changes):
    parts = {
        "cost": ca.bilin(ca.SX(W), u.sx, u.sx) + ca.dot(w.sx, u.sx) + w.sx[0] ** 2,
        "equalities": v.sx - J.sx @ u.sx,
        "inequalities": ca.vertcat(u.sx[0] * w.sx[1] - 4 * u.sx[2] - v.sx[0]),
        "lower": -ca.fmax(w.sx, 1),
        "upper": ca.SX([5, np.inf, 7]),
    } | changes
    return Formulation(name="t", decision=u, parameters=(J, v, w), **parts)


def test_standard_form_by_hand():
    problem = declared().qp.at(**GIVEN)
    np.testing.assert_array_equal(problem.P, 2 * W)
    np.testing.assert_array_equal(problem.q, GIVEN["w"])
    np.testing.assert_array_equal(problem.A, GIVEN["J"])
    np.testing.assert_array_equal(problem.b, GIVEN["v"])
    np.testing.assert_array_equal(problem.G, [[2.0, 0.0, -4.0]])
    np.testing.assert_allclose(problem.h, [0.3])
    np.testing.assert_array_equal(problem.lb, [-1.0, -2.0, -3.0])
    np.testing.assert_array_equal(problem.ub, [5.0, np.inf, 7.0])


@settings(max_examples=30)
@given(x=st.lists(st.floats(-3, 3), min_size=3, max_size=3).map(np.array))
def test_standard_form_has_the_values_of_the_declaration(x):
    form = FORM
    problem = form.qp.at(**GIVEN)
    inputs = [x, *GIVEN.values()]
    values = [np.asarray(value).ravel() for value in form.function().call(inputs)]
    cost = x @ problem.P @ x / 2 + problem.q @ x + GIVEN["w"][0] ** 2
    np.testing.assert_allclose(values[0], [cost], rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(values[1], problem.b - problem.A @ x, atol=1e-12)
    np.testing.assert_allclose(values[2], problem.G @ x - problem.h, atol=1e-12)


FORM = declared()


def test_absent_parts_are_none():
    form = Formulation("t", u, (), cost=ca.sumsqr(u.sx))
    problem = form.qp.at()
    for field in ("A", "b", "G", "h", "lb", "ub"):
        assert getattr(problem, field) is None
    assert not form.qp.bounded
    assert FORM.qp.bounded


def test_functions_of_the_parameters():
    qp = FORM.qp.functions()["qp"]
    assert [qp.name_in(i) for i in range(qp.n_in())] == ["J", "v", "w"]
    assert qp.name_out(0) == "qp_P"
    assert [qp.size_out(i) for i in range(qp.n_out())] == [
        *[(3, 3), (3, 1), (2, 3), (2, 1), (1, 3), (1, 1), (3, 1), (3, 1)]
    ]


@pytest.mark.parametrize(
    ("change", "error", "text"),
    [
        ({"v": None}, RrnnError, "'v' is missing; parameters are J, v, w"),
        ({"x": 1.0}, RrnnError, "'x' is unknown"),
        ({"v": [1.0, 2.0, 3.0]}, ShapeError, "v: expected"),
        ({"v": [[1.0, 2.0]]}, ShapeError, "v: expected"),
        ({"J": np.zeros((3, 2))}, ShapeError, "J: expected"),
        ({"J": 0.0}, ShapeError, "J: expected"),
        ({"w": [1.0, np.nan, 0.0]}, NotFiniteError, "w: every"),
        ({"w": [1.0, np.inf, 0.0]}, NotFiniteError, "w: every"),
        ({"w": [-9.0, 0.0, 1e308]}, None, ""),
    ],
)
def test_parameters_are_checked(change, error, text):
    given = {k: x for k, x in (GIVEN | change).items() if x is not None}
    if error is None:
        FORM.qp.at(**given)
        return
    with pytest.raises(error, match=text):
        FORM.qp.at(**given)


def test_an_infinite_coefficient_is_refused():
    form = declared(equalities=ca.vertcat(u.sx[0] / w.sx[0]))
    with pytest.raises(NotFiniteError, match=r"qp\.at: A"):
        form.qp.at(**(GIVEN | {"w": np.zeros(3)}))


def test_an_empty_bound_is_named():
    form = declared(lower=w.sx, upper=ca.SX([2, 1, 4]))
    with pytest.raises(InfeasibleQpError, match=r"bound 1 is empty, \[2, 1\]"):
        form.qp.at(**GIVEN)


def test_a_parameter_dependent_hessian_is_refused_with_its_entry():
    cost = ca.sumsqr(u.sx) + (w.sx[0] ** 2) * u.sx[0] * u.sx[2]
    with pytest.raises(NotAQpError, match="parameter-dependent Hessian") as error:
        declared(cost=cost)
    assert error.value.where == "cost"
    assert error.value.expression == "P[2,0] = sq(w_0)"


def test_an_indefinite_hessian_is_refused_with_a_direction():
    cost = u.sx[0] ** 2 - u.sx[1] ** 2 + u.sx[2] ** 2
    with pytest.raises(NotAQpError, match=r"indefinite Hessian.*v = \[0, 1, 0\]"):
        declared(cost=cost)


def test_semidefinite_is_decided_exactly():
    a, b, _ = ca.vertsplit(u.sx)
    declared(cost=(a + b) ** 2)
    below = float(np.nextafter(1.0, 0.0))
    with pytest.raises(NotAQpError, match="indefinite"):
        declared(cost=a**2 + 2 * a * b + below * b**2)


def test_solvers_are_imported_only_when_asked():
    code = (
        "import sys, rrnn_opt.formulation, rrnn_opt.networks.primal_dual;"
        "assert 'qpsolvers' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_convexity_is_checked_again_with_the_numbers():
    # a standard form made by hand has not been through the declaration's gate
    bent = dataclasses.replace(FORM.qp, P=ca.SX(np.diag([1.0, -1e-6, 1.0])))
    with pytest.raises(NotAQpError, match=r"qp\.at: indefinite Hessian; eigenvalue"):
        bent.at(**GIVEN)
