import casadi as ca
import numpy as np
import pytest

from rrnn_opt.errors import ShapeError
from rrnn_opt.symbolic.interpreter import evaluate, sincos
from rrnn_opt.symbolic.tape import OPERATIONS, Tape

REALS = [np.float64, np.float32]


def around_zeros(real, radius):
    """Numbers next to multiples of pi/2, where reduction cancels most."""
    centres = (np.arange(-31, 32) * (np.pi / 2)).astype(real)
    below, above, points = centres, centres, [centres]
    for _ in range(radius):
        below, above = np.nextafter(below, real(-99)), np.nextafter(above, real(99))
        points += [below, above]
    return np.concatenate(points)


@pytest.mark.parametrize("real", REALS)
def test_sincos_is_within_two_ulp(real):
    uniform = np.random.default_rng(1).uniform(-50, 50, 200_000).astype(real)
    x = np.concatenate([uniform, around_zeros(real, 20), uniform * real(1e-6)])
    wide = x.astype(np.longdouble)
    for ours, exact in zip(sincos(x), (np.sin(wide), np.cos(wide)), strict=True):
        assert ours.dtype == real
        ulp = np.spacing(np.abs(exact).astype(real)).astype(np.longdouble)
        assert np.max(np.abs(ours - exact) / ulp) <= 2


@pytest.mark.parametrize(("real", "reach"), [(np.float64, 1e9), (np.float32, 3e4)])
def test_sincos_degrades_no_faster_than_its_argument(real, reach):
    x = np.random.default_rng(2).uniform(-reach, reach, 50_000).astype(real)
    wide = x.astype(np.longdouble)
    for ours, exact in zip(sincos(x), (np.sin(wide), np.cos(wide)), strict=True):
        assert np.max(np.abs(ours - exact)) <= 2 * np.spacing(real(reach))


@pytest.mark.parametrize("real", REALS)
def test_sincos_of_what_has_no_sine_is_nan(real):
    x = np.array([np.nan, np.inf, -np.inf, 3e9, -3e38], real)
    for ours in sincos(x):
        assert np.isnan(ours).all()


COMPUTED = [
    r for r in OPERATIONS.values() if r.name not in ("input", "output", "const")
]


@pytest.mark.parametrize("row", COMPUTED, ids=lambda row: row.name)
def test_every_operation_agrees_with_casadi(row):
    a, b = ca.SX.sym("a"), ca.SX.sym("b")
    build = {
        "sub": lambda: a - b, "add": lambda: a + b, "mul": lambda: a * b,
        "div": lambda: a / b, "neg": lambda: -a, "sq": lambda: a * a,
        "twice": lambda: 2 * a, "inv": lambda: 1 / a, "lt": lambda: a < b,
        "le": lambda: a <= b, "eq": lambda: a == b, "ne": lambda: a != b,
        "not": lambda: ca.logic_not(a), "and": lambda: ca.logic_and(a, b),
        "or": lambda: ca.logic_or(a, b), "pow": lambda: a**b,
        "if_else_zero": lambda: ca.if_else(a, b, 0),
    }  # fmt: skip
    arguments = (a, b)[: row.arity]
    make = build.get(row.name) or (lambda: getattr(ca, row.name)(*arguments))
    fn = ca.Function("f", [a, b], [make()], ["a", "b"], ["r"])
    tape = Tape.of(fn)
    if row.name == "twice" and (2 * a).op() == ca.OP_MUL:
        pytest.skip("CasADi before 3.8 writes 2 a as a product")
    assert row.name in tape.operations
    grid = [0.0, 0.25, 0.5, 1.0, 0.75, -0.5, -1.0, 2.0]
    if row.name in ("acos", "asin"):
        grid = grid[:-1]
    for x in grid:
        for y in grid:
            ours = float(evaluate(tape, [np.array(x), np.array(y)])[0][0, 0])
            theirs = float(fn(x, y))
            assert ours == pytest.approx(theirs, rel=1e-14, abs=1e-15, nan_ok=True)


def test_further_axes_are_evaluated_side_by_side():
    x, y = ca.SX.sym("x", 2), ca.SX.sym("y", 2, 2)
    fn = ca.Function("f", [x, y], [y @ x, ca.SX(2, 3)], ["x", "y"], ["p", "zero"])
    rng = np.random.default_rng(0)
    xs, ys = rng.normal(size=(2, 1, 5)), rng.normal(size=(2, 2))[..., None]
    product, zero = evaluate(Tape.of(fn), [xs, ys])
    assert product.shape == (2, 1, 5)
    assert zero.shape == (2, 3, 5)
    assert not zero.any()
    np.testing.assert_allclose(product[:, 0], ys[..., 0] @ xs[:, 0], rtol=1e-15)


def test_wrong_inputs_are_refused():
    x = ca.SX.sym("x", 2)
    tape = Tape.of(ca.Function("f", [x], [x], ["x"], ["y"]))
    with pytest.raises(ShapeError, match="x"):
        evaluate(tape, [np.zeros(3)])
    with pytest.raises(ShapeError, match="inputs"):
        evaluate(tape, [])
