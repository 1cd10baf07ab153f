import casadi as ca
import numpy as np
import pytest

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
p = Symbol.vector("p", 2)
U, P = u.sx, p.sx
COST = ca.sumsqr(U)


def form(**parts):
    return Formulation("t", u, (p,), **({"cost": COST} | parts))


def test_absent_parts_become_empty_or_infinite():
    made = form()
    assert made.equalities.shape == (0, 1)
    assert made.inequalities.shape == (0, 1)
    assert np.all(np.asarray(ca.DM(made.lower)) == -np.inf)
    assert np.all(np.asarray(ca.DM(made.upper)) == np.inf)


REFUSED = [
    ("fabs", ca.fabs(U[0]), "fabs(u[0])"),
    ("fmin", ca.fmin(U[0], 1), "fmin(u[0], 1)"),
    ("fmax", ca.fmax(U[0], 1), "fmax(u[0], 1)"),
    ("if_else", ca.if_else(U[0] > 0, U[0], 2 * U[0]), "(0 < u[0])"),
    ("floor", ca.floor(U[0]), "floor(u[0])"),
]


@pytest.mark.parametrize(("operation", "expr", "text"), REFUSED)
def test_kinks_are_refused_in_every_part(operation, expr, text):
    rows = ca.vertcat(U[1], expr + P[0])
    places = [
        ({"cost": COST + P[1] * expr}, "cost"),
        ({"equalities": rows}, "equality row 1"),
        ({"inequalities": rows}, "inequality row 1"),
        ({"lower": ca.vertcat(0, 0, expr)}, "lower bound row 2"),
        ({"upper": ca.vertcat(expr, 0, 0)}, "upper bound row 0"),
    ]
    for parts, where in places:
        with pytest.raises(NotAQpError) as error:
            form(**parts)
        assert error.value.where == where
        if "bound" not in where:  # there the decision itself is the offence
            assert operation in error.value.operation
            assert error.value.expression == text
            assert text in str(error.value)


def test_products_of_decisions_belong_to_the_cost_only():
    form(cost=COST + U[0] * U[1])
    for part, where in (("equalities", "equality"), ("inequalities", "inequality")):
        with pytest.raises(NotAQpError, match="product of degree 2") as error:
            form(**{part: U[0] * U[1] - P[0]})
        assert error.value.where == where
        assert error.value.expression == "(u[0] * u[1])"


def test_a_cubic_cost_is_refused():
    with pytest.raises(NotAQpError, match=r"cost: mul \(product of degree 3"):
        form(cost=COST + U[2] ** 3)


def test_indefinite_and_parameter_dependent_hessians_are_refused():
    with pytest.raises(NotAQpError, match="cost: indefinite Hessian"):
        form(cost=U[0] ** 2 - U[1] ** 2)
    with pytest.raises(NotAQpError, match=r"parameter-dependent Hessian in 'P\[0,0\]"):
        form(cost=COST + P[0] ** 2 * U[0] ** 2)


def test_the_bound_itself_may_not_move_with_the_decision():
    with pytest.raises(NotAQpError, match="free of 'u'"):
        form(lower=U)


@pytest.mark.parametrize(
    ("part", "value"),
    [
        ("cost", U),
        ("cost", COST * ca.SX.ones(3)),
        ("equalities", U.T),
        ("equalities", ca.horzcat(U, U)),
        ("inequalities", U.T),
        ("lower", ca.SX(-1)),
        ("lower", -ca.SX.ones(1, 3)),
        ("upper", ca.SX(1)),
        ("upper", P),
        ("upper", ca.SX.ones(3, 3)),
    ],
)
def test_nothing_is_broadcast(part, value):
    with pytest.raises(ShapeError, match=f"t: {part}: expected shape"):
        form(**{part: value})


def test_a_row_is_no_decision():
    with pytest.raises(ShapeError, match="t: decision"):
        Formulation("t", Symbol.matrix("u", (1, 3)), (), cost=ca.SX(0))


def test_undeclared_and_double_symbols_are_named():
    with pytest.raises(RrnnError, match=r"t: cost: depends on x; declare"):
        form(cost=COST + ca.SX.sym("x"))
    with pytest.raises(RrnnError, match="'u'"):
        Formulation("t", u, (Symbol.scalar("u"),), cost=COST)


def test_a_bound_that_is_nan_is_refused():
    with pytest.raises(NotFiniteError, match="lower"):
        form(lower=ca.SX([0, np.nan, 0]))


def test_frozen_and_fingerprinted():
    made = form(equalities=U - 1)
    with pytest.raises(AttributeError):
        made.cost = COST
    assert made.fingerprint == form(equalities=U - 1).fingerprint
    assert made.fingerprint != form(equalities=U - 2).fingerprint
    assert made.fingerprint != form(inequalities=U - 1).fingerprint


def test_the_level_is_one_of_three():
    assert form().level == "velocity"
    assert form().inverse == ""
    assert form(level="acceleration").level == "acceleration"
    with pytest.raises(RrnnError, match="level: expected one of velocity"):
        form(level="torque")


@pytest.mark.parametrize("name", ["my law", "1st", "a__b", ""])
def test_a_name_that_no_c_function_can_have_is_refused(name):
    with pytest.raises(RrnnError, match="C identifier"):
        Formulation(name, u, (p,), COST)


@pytest.mark.parametrize(
    "parts", [{"lower": [np.inf, 0, 0]}, {"upper": [0, 0, -np.inf]}]
)
def test_a_bound_at_infinity_that_leaves_nothing_is_infeasible(parts):
    made = form(**{side: ca.DM(values) for side, values in parts.items()})
    with pytest.raises(InfeasibleQpError, match="is empty"):
        made.qp.at(p=[0.0, 0.0])
