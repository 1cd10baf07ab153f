import casadi as ca
import numpy as np
import pytest

from rrnn_opt.dynamics import DiscreteDynamics, Euler, NeuralDynamics
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


def halving(**parts):
    given = {"next": x.sx / 2, "output": x.sx, "residual": x.sx} | parts
    return DiscreteDynamics("halving", x, (p,), **given)


def test_a_map_is_its_own_step():
    law = halving()
    assert law.step(Euler(0.1)) is law
    h = Symbol.scalar("h", "s")
    told = law.step(Euler(h))
    assert [s.name for s in told.parameters] == ["p", "h"]
    following, output = told.functions()["step"]([2, 4], [0, 0], 0.3)
    assert np.asarray(following).ravel().tolist() == [1.0, 2.0]
    assert np.asarray(output).ravel().tolist() == [2.0, 4.0]


def test_a_step_keeps_what_a_run_reads():
    law = make(start=p.sx + 1)
    step = law.step(Euler(0.25))
    assert isinstance(step, DiscreteDynamics)
    assert step.multipliers == law.multipliers
    assert set(step.functions()) == {"step", "output", "residual", "duals"}
    for part in ("start", "residual", "output"):
        assert ca.is_equal(getattr(step, part), getattr(law, part), 5)


@pytest.mark.parametrize("build", [make, halving])
def test_a_run_starts_where_the_parameters_say(build):
    assert np.asarray(ca.DM(build().start)).ravel().tolist() == [0.0, 0.0]
    with pytest.raises(RrnnError, match="start: depends on x_0"):
        build(start=x.sx)
    with pytest.raises(ShapeError, match="start"):
        build(start=ca.SX(1))


def test_frozen_data_have_no_rates():
    speed = Symbol.vector("p_rate", 2, "1/s")
    law = NeuralDynamics(
        "law",
        x,
        (p, speed),
        derivative=p.sx - x.sx + speed.sx,
        output=x.sx + speed.sx,
        residual=p.sx - x.sx + speed.sx,
        multipliers={"lam": speed.sx[0] + x.sx[1]},
        start=speed.sx,
        rates={"p": speed},
    )
    still = law.frozen
    assert still.parameters == (p,)
    assert not still.rates
    assert still.frozen is still
    functions = still.functions()
    assert np.asarray(functions["derivative"]([1, 2], [3, 5])).ravel().tolist() == [
        2,
        3,
    ]
    assert np.asarray(functions["output"]([1, 2], [3, 5])).ravel().tolist() == [1, 2]
    assert float(functions["duals"]([1, 2], [3, 5])) == 2.0
    assert np.asarray(ca.DM(still.start)).ravel().tolist() == [0.0, 0.0]
