"""Columns worked out several at once, against one by one and against pinocchio."""

import casadi as ca
import numpy as np
import pinocchio as pin
import pytest

import rrnn_opt as rr
from benchmarks.ratios.kinematics import pinocchio_model
from rrnn_opt import emit
from rrnn_opt.emit.lanes import PORTABLE, WIDTHS, lanes_source
from rrnn_opt.errors import (
    LayoutError,
    RrnnError,
    ShapeError,
    UnsupportedOperationError,
)
from rrnn_opt.symbolic.tape import Instruction, Port, Tape
from tests.emit.test_sincos import points

Q = ca.SX.sym("q", 3)
M = ca.SX.sym("M", 2, 3)
FUNCTION = ca.Function(
    "parts", [Q, M], [M @ Q, ca.sin(Q) @ Q.T, M], ["q", "M"], list("abc")
)


def widths():
    x = ca.SX.sym("x")
    widest = emit.compile_batch(ca.Function("probe", [x], [x])).lanes
    return [k for k in (*WIDTHS, PORTABLE) if k <= widest]


@pytest.fixture(scope="module")
def parts():
    return emit.compile_batch(FUNCTION)


def compared(functions, lanes, n, assert_equal):
    """Batches beside the compiled scalar function, column by column."""
    rng = np.random.default_rng(7)
    program = emit.compile(functions, name="scalars")
    for fn in functions:
        x, a = rng.normal(size=(4, n)), rng.normal(size=(2, 2, n))
        results = emit.compile_batch(fn, lanes=lanes)(x, a)
        for k in range(n):
            columns = (x[:, k].copy(), np.asfortranarray(a[:, :, k]))
            for many, one in zip(
                results, program.call(fn.name(), *columns), strict=True
            ):
                assert_equal(many[..., k], one)


@pytest.mark.parametrize("lanes", widths())
def test_exact_operations_give_the_bits_of_the_scalar_code(wild_functions, lanes):
    compared(wild_functions[:4], lanes, 19, np.testing.assert_array_equal)


@pytest.mark.parametrize("lanes", widths())
def test_library_functions_agree(tame_functions, lanes):
    def near(x, y):
        np.testing.assert_allclose(x, y, rtol=1e-12, atol=1e-13)

    compared(tame_functions[:2], lanes, 11, near)


@pytest.mark.parametrize("lanes", widths())
def test_sine_and_cosine_give_the_bits_of_the_scalar_code(lanes):
    x = ca.SX.sym("x")
    fn = ca.Function("turn", [x], [ca.sin(x), ca.cos(x)])
    at = points(np.float64)
    at = np.concatenate([at, at * 2.0**25, [np.inf, -np.inf, np.nan, -0.0, 0.0]])
    many = emit.compile_batch(fn, lanes=lanes)(at[None])
    ones = emit.compile(fn).map("turn", at[:, None], n=len(at))
    for ours, theirs in zip(many, ones, strict=True):
        np.testing.assert_array_equal(ours[0], theirs[:, 0])
        np.testing.assert_array_equal(np.signbit(ours[0]), np.signbit(theirs[:, 0]))


@pytest.mark.parametrize(
    "name", [pytest.param("pa10", marks=pytest.mark.slow), "panda"]
)
def test_kinematics_agree_with_pinocchio(name):
    robot = rr.Robot.builtin(name)
    kin = rr.Kinematics(robot)
    fn = ca.Function("tip", [kin.q], [kin.position(), kin.jacobian()])
    q = np.random.default_rng(3).uniform(-3, 3, (robot.nv, 101))
    model, tip = pinocchio_model(robot)
    data = model.createData()
    for fused in (False, True):
        position, jacobian = emit.compile_batch(fn, fused=fused)(q)
        for k in range(q.shape[1]):
            theirs = pin.computeFrameJacobian(
                model, data, q[:, k], tip, pin.LOCAL_WORLD_ALIGNED
            )
            pin.updateFramePlacement(model, data, tip)
            np.testing.assert_allclose(
                position[:, k], data.oMf[tip].translation, atol=1e-12
            )
            np.testing.assert_allclose(jacobian[:, :, k], theirs[:3], atol=1e-12)


def test_any_function_of_a_formulation():
    """All of a scheme's QP, against CasADi's own virtual machine."""
    robot = rr.Kinematics(rr.Robot.builtin("planar3"))
    fn = rr.formulations.closed_loop(robot).function()
    rng = np.random.default_rng(5)
    shapes = [fn.size_in(i) for i in range(fn.n_in())]
    arguments = [rng.normal(size=(r, 24) if c == 1 else (r, c, 24)) for r, c in shapes]
    results = emit.compile_batch(fn)(*arguments)
    for k in range(24):
        for ours, theirs in zip(
            results, fn.call([a[..., k] for a in arguments]), strict=True
        ):
            near = theirs.full().reshape(ours[..., k].shape)
            np.testing.assert_allclose(ours[..., k], near, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("n", [0, 1, 7, 8, 9, 16, 511, 512, 1024])
def test_any_number_of_columns(parts, n):
    rng = np.random.default_rng(n)
    q, m = rng.normal(size=(3, n)), rng.normal(size=(2, 3, n))
    a, b, c = parts(q, m)
    assert (a.shape, b.shape, c.shape) == ((2, n), (3, 3, n), (2, 3, n))
    np.testing.assert_allclose(a, np.einsum("ijn,jn->in", m, q), atol=1e-14)
    np.testing.assert_allclose(b, np.einsum("in,jn->ijn", np.sin(q), q), atol=1e-14)
    np.testing.assert_array_equal(c, m)


def test_single_values_serve_all_columns_and_rooms_are_reused(parts):
    rng = np.random.default_rng(1)
    q, m = rng.normal(size=(3, 40)), rng.normal(size=(2, 3))
    room = parts.room(40)
    results = parts(q, m, out=room)
    assert all(result is given for result, given in zip(results, room, strict=True))
    np.testing.assert_allclose(results[0], m @ q, atol=1e-14)
    run, bound = parts.bind(q, m)
    q[:] = rng.normal(size=(3, 40))
    run()
    np.testing.assert_allclose(bound[0], m @ q, atol=1e-14)
    chained = parts(results[1][:, 0], results[2])
    np.testing.assert_allclose(chained[0], m @ results[1][:, 0], atol=1e-14)
    turned = parts(np.asfortranarray(q), m.tolist())
    np.testing.assert_array_equal(turned[0], bound[0])


def test_wrong_arrays_are_named(parts):
    q, m, room = np.zeros((3, 8)), np.zeros((2, 3)), parts.room(8)
    for arrays in [(q,), (q[:2], m), (q, np.zeros((2, 3, 9))), (q, np.zeros((3, 2)))]:
        with pytest.raises(ShapeError):
            parts(*arrays)
    with pytest.raises(RrnnError, match="no argument has columns"):
        parts(q[:, 0], m)
    with pytest.raises(ShapeError):
        parts(q, m, out=room[:2])
    with pytest.raises(LayoutError, match="room"):
        parts(q, m, out=[np.asfortranarray(r) for r in room])
    with pytest.raises(LayoutError, match="share no memory"):
        parts(room[0][:1].repeat(3, 0), room[2], out=room)


def test_lanes_that_the_processor_lacks_are_refused():
    for lanes in (0, 3, 16):
        with pytest.raises(RrnnError, match="lanes must be one of"):
            emit.compile_batch(FUNCTION, lanes=lanes)


def test_unknown_operations_are_refused():
    steps = (Instruction("input", 0, (), None, (0, 0)), Instruction("erf", 1, (0,)))
    port = (Port("x", (1, 1)),)
    with pytest.raises(UnsupportedOperationError):
        lanes_source(Tape("f", port, port, steps, 2), "f")
