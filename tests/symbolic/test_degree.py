import casadi as ca
import pytest

from rrnn_opt.errors import NotAQpError
from rrnn_opt.symbolic import Symbol, require_degree

u = Symbol.vector("u", 3)
p = Symbol.vector("p", 2)
U, P = u.sx, p.sx


def walk(expr, most):
    require_degree(expr, u, (p,), most=most, where="part")


@pytest.mark.parametrize(
    ("expr", "degree"),
    [
        (ca.SX(3), 0),
        (
            ca.fabs(P[0])
            + ca.fmin(P[1], 2)
            + ca.floor(P[0])
            + ca.atan2(*ca.vertsplit(P)),
            0,
        ),
        (ca.if_else(P[0] > 0, P[0], P[1]), 0),
        (U[0], 1),
        (-U[0] + 2 * U[1] - U[2] / ca.cos(P[0]), 1),
        (ca.sin(P[0]) * U[0] + ca.sqrt(P[1]) * (U[1] - 7), 1),
        (U[0] * U[1], 2),
        (U[0] ** 2 / P[0] + (U[1] + P[0]) * (U[2] - 1), 2),
    ],
)
def test_polynomials_have_their_degree(expr, degree):
    for most in range(3):
        if most >= degree:
            walk(expr, most)
        else:
            with pytest.raises(NotAQpError):
                walk(expr, most)


@pytest.mark.parametrize(
    ("expr", "operation", "text"),
    [
        (ca.fabs(U[0]), "fabs", "fabs(u[0])"),
        (ca.fmin(U[1], 1), "fmin", "fmin(u[1], 1)"),
        (ca.fmax(U[1], P[0]), "fmax", "fmax(u[1], p[0])"),
        (ca.if_else(U[0] > 0, U[0], U[1]), "if_else", "(0 < u[0])"),
        (ca.if_else(P[0] > 0, U[0], U[1]), "if_else", "u[0]"),
        (ca.floor(U[2]), "floor", "floor(u[2])"),
        (ca.sign(U[2]), "sign", "sign(u[2])"),
        (U[0] ** 3, "mul (product of degree 3", "(u[0] * sq(u[0]))"),
        ((U[0] ** 2) ** 2, "sq (product of degree 4", "sq(sq(u[0]))"),
        (1 / U[0], "inv", "inv(u[0])"),
        (P[0] / U[0], "div", "(p[0] / u[0])"),
        (ca.sin(U[0] * P[0]), "sin", "sin("),
        (ca.exp(U[0]), "exp", "exp(u[0])"),
        (U[0] ** P[0], "pow", "pow(u[0], p[0])"),
    ],
)
def test_everything_else_is_refused_by_name(expr, operation, text):
    with pytest.raises(NotAQpError) as error:
        walk(expr + U[1] * P[1], 2)
    assert operation in error.value.operation
    assert text in error.value.expression
    assert error.value.where == "part"
    assert operation in str(error.value)
    assert "quadratic in 'u'" in str(error.value)


def test_the_row_is_named():
    rows = ca.vertcat(U[0], P[0] * U[1], U[1] + U[0] * U[2], U[2])
    with pytest.raises(NotAQpError, match="affine in 'u'") as error:
        walk(rows, 1)
    assert error.value.where == "part row 2"
    assert error.value.expression == "(u[0] * u[2])"


def test_a_long_subexpression_is_cut():
    deep = U[0]
    for _ in range(200):
        deep = P[0] * deep + 1
    with pytest.raises(NotAQpError) as error:
        walk(ca.fabs(deep), 2)
    assert ".." in error.value.expression
    assert len(str(error.value)) < 200


def test_casadis_own_split_is_no_gate():
    # why the walk exists: a kink is taken for a quadratic with zero Hessian
    hessian, _, _ = ca.quadratic_coeff(ca.fabs(U[0]), U)
    assert ca.SX(hessian).is_zero()
