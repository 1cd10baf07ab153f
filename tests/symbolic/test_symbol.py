import casadi as ca
import numpy as np
import pytest

from rrnn_opt.errors import NotFiniteError, RrnnError, ShapeError
from rrnn_opt.symbolic import (
    Symbol,
    arguments,
    dense,
    number,
    require_declared,
    require_names,
    require_shape,
)


def test_symbols_carry_shape_unit_and_meaning():
    J = Symbol.matrix("J", (2, 3), "m/rad", "task Jacobian")
    assert (J.shape, J.size, J.unit, J.meaning) == ((2, 3), 6, "m/rad", "task Jacobian")
    assert Symbol.vector("q", 4).shape == (4, 1)
    assert Symbol.scalar("h", "s").shape == (1, 1)


@pytest.mark.parametrize("name", ["", "1q", "r dot", "q'", "q\n"])
def test_a_name_is_a_c_identifier(name):
    with pytest.raises(RrnnError, match="C identifier"):
        Symbol(name, ca.SX.sym("q"))


def test_an_expression_is_no_symbol():
    with pytest.raises(RrnnError, match="not an expression"):
        Symbol("q", 2 * ca.SX.sym("q"))


@pytest.mark.parametrize("got", [(3, 1), (1, 2), (2, 2), (1, 1)])
def test_no_other_shape_passes(got):
    with pytest.raises(ShapeError, match=r"J: expected shape \(2, 1\)") as error:
        require_shape(ca.SX.sym("J", *got), (2, 1), "J")
    assert (error.value.want, error.value.got) == ((2, 1), got)


def test_a_flat_array_counts_as_a_column_only():
    require_shape(np.zeros(3), (3, 1), "q")
    with pytest.raises(ShapeError):
        require_shape(np.zeros(3), (1, 3), "q")


def test_dense_fills_structural_zeros_without_changing_values():
    sparse = ca.SX(2, 2)
    sparse[0, 1] = ca.SX.sym("x")
    filled = dense(sparse, (2, 2), "m")
    assert filled.is_dense()
    assert float(filled[1, 0]) == 0.0
    assert filled[0, 1].is_symbolic()


def test_an_undeclared_symbol_is_named():
    x, y = Symbol.vector("x", 2), ca.SX.sym("y", 2)
    require_declared(x.sx[0] * 2, (x,), "V")
    with pytest.raises(RrnnError, match=r"V: depends on y_1; declare"):
        require_declared(x.sx[0] + y[1], (x,), "V")


def test_a_symbol_of_the_same_name_is_not_the_same_symbol():
    x = Symbol.vector("x", 2)
    with pytest.raises(RrnnError, match="x_0"):
        require_declared(ca.SX.sym("x", 2)[0], (x,), "V")


def test_two_of_one_name_are_refused():
    with pytest.raises(RrnnError, match="'q'"):
        require_names((Symbol.scalar("q"), Symbol.vector("q", 2)), "here")
    both = Symbol.vector("both", 2)
    with pytest.raises(RrnnError, match="'both' and 'part' are one variable"):
        require_names((both, Symbol("part", both.sx[1])), "here")


def test_numbers_take_the_symbols_shape():
    J = Symbol.matrix("J", (2, 3))
    value = number(J, [[1, 2, 3], [4, 5, 6]])
    assert value.shape == (2, 3)
    assert value.flags.f_contiguous
    assert number(Symbol.scalar("h"), 0.5).shape == (1, 1)


@pytest.mark.parametrize("value", [1.0, [[1.0, 2.0, 3.0]], [1.0, 2.0], [[1.0]]])
def test_numbers_are_never_broadcast(value):
    with pytest.raises(ShapeError, match="q: expected"):
        number(Symbol.vector("q", 3), value)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_numbers_are_finite(bad):
    with pytest.raises(NotFiniteError, match="q"):
        number(Symbol.vector("q", 2), [0.0, bad])


def test_arguments_come_in_order_and_names_are_checked():
    symbols = (Symbol.vector("q", 2), Symbol.scalar("h"))
    first, second = arguments(symbols, {"h": 2.0, "q": [3.0, 4.0]}, "here")
    assert first.tolist() == [[3.0], [4.0]]
    assert second.tolist() == [[2.0]]
    with pytest.raises(RrnnError, match="here: 'h' is missing, 'x' is unknown"):
        arguments(symbols, {"q": [3.0, 4.0], "x": 1.0}, "here")
