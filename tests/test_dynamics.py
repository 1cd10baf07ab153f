import casadi as ca
import numpy as np
import pytest

from rrnn_opt.dynamics import Euler, NeuralDynamics
from rrnn_opt.errors import RrnnError, ShapeError
from rrnn_opt.symbolic import Symbol

x = Symbol.vector("x", 2, "rad")
p = Symbol.vector("p", 2)


def make(**parts):
    given = {
        "derivative": p.sx - x.sx,
        "output": 2 * x.sx[0],
        "residual": p.sx - x.sx,
        "multipliers": {"lam": x.sx[1]},
    } | parts
    return NeuralDynamics("decay", x, (p,), **given)


def test_functions_evaluate_the_expressions():
    functions = make().functions()
    assert set(functions) == {"derivative", "output", "residual", "duals"}
    assert "duals" not in make(multipliers={}).functions()
    derivative = functions["derivative"]
    assert [derivative.name_in(i) for i in range(2)] == ["x", "p"]
    assert np.asarray(derivative([1, 2], [3, 5])).ravel().tolist() == [2.0, 3.0]
    assert float(functions["output"]([1, 2], [3, 5])) == 2.0
    assert list(make().duals()) == ["lam"]


def test_euler_step():
    step = make().step(Euler(0.25)).functions()["step"]
    following, output = step([1, 2], [3, 6])
    assert np.asarray(following).ravel().tolist() == [1.5, 3.0]
    assert float(output) == 2.0


def test_the_step_size_may_be_an_argument():
    h = Symbol.scalar("h", "s")
    step = make().step(Euler(h))
    assert [s.name for s in step.parameters] == ["p", "h"]
    following, _ = step.functions()["step"]([1, 2], [3, 6], 0.5)
    assert np.asarray(following).ravel().tolist() == [2.0, 4.0]
    with pytest.raises(RrnnError, match="'p'"):
        make().step(Euler(Symbol.scalar("p")))


@pytest.mark.parametrize("h", [0.0, -1.0, np.nan, np.inf])
def test_a_step_is_positive_and_finite(h):
    with pytest.raises(RrnnError, match="positive and finite"):
        Euler(h)


def test_a_step_is_scalar():
    with pytest.raises(ShapeError):
        Euler(Symbol.vector("h", 2))


@pytest.mark.parametrize("part", ["derivative", "residual", "output"])
@pytest.mark.parametrize("value", [ca.SX.ones(1, 2), ca.SX.ones(2, 2)])
def test_nothing_is_broadcast(part, value):
    with pytest.raises(ShapeError, match=f"decay: {part}"):
        make(**{part: value})


@pytest.mark.parametrize("part", ["derivative", "residual"])
def test_a_scalar_is_no_derivative(part):
    with pytest.raises(ShapeError, match=part):
        make(**{part: ca.SX(1)})


@pytest.mark.parametrize("part", ["derivative", "residual", "output"])
def test_undeclared_symbols_are_named(part):
    with pytest.raises(RrnnError, match=f"decay: {part}: depends on z_"):
        make(**{part: x.sx + ca.SX.sym("z", 2)})
