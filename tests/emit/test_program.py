import subprocess
import sys

import casadi as ca
import numpy as np
import pytest

from rrnn_opt import emit
from rrnn_opt.emit.compiler import _zig
from rrnn_opt.errors import LayoutError, RrnnError, ShapeError

Q = ca.SX.sym("q", 7)
M = ca.SX.sym("M", 3, 7)
S = ca.SX.sym("s")
FUNCTION = ca.Function(
    "parts",
    [Q, M, S],
    [M @ Q, ca.sin(Q) * S, M.T, S, ca.SX(0, 0)],
    ["q", "M", "s"],
    ["v", "w", "T", "r", "nothing"],
)


@pytest.fixture(scope="module")
def program():
    return emit.compile(FUNCTION, name="demo")


@pytest.fixture
def q():
    return np.linspace(-1, 1, 7)


@pytest.fixture
def matrix():
    return np.asfortranarray(np.arange(21.0).reshape(3, 7))


def test_call_returns_columns_as_vectors_and_matrices_column_major(program, q, matrix):
    v, w, t, r, nothing = program.call("parts", q, matrix, np.array([2.0]))
    np.testing.assert_allclose(v, matrix @ q, rtol=1e-14, atol=1e-14)
    np.testing.assert_allclose(w, 2 * np.sin(q), rtol=1e-15)
    np.testing.assert_array_equal(t, matrix.T)
    assert t.flags.f_contiguous
    assert (v.shape, w.shape, t.shape, r.shape) == ((3,), (7,), (7, 3), (1,))
    assert nothing.size == 0


def test_every_shape_of_a_column_and_a_scalar_is_taken(program, q, matrix):
    wanted = program.call("parts", q, matrix, np.array([2.0]))
    for column in (q, q[:, None]):
        for scalar in (np.array(2.0), np.array([2.0]), np.array([[2.0]])):
            for a, b in zip(
                program.call("parts", column, matrix, scalar), wanted, strict=True
            ):
                np.testing.assert_array_equal(a, b)


def test_results_go_where_they_are_told(program, q, matrix):
    out = tuple(np.zeros(s, order="F") for s in [(3,), (7,), (7, 3), (1,), (0, 0)])
    got = program.call("parts", q, matrix, np.array([2.0]), out=out)
    assert all(a is b for a, b in zip(got, out, strict=True))
    np.testing.assert_array_equal(out[2], matrix.T)


def test_read_only_arguments_are_fine_and_read_only_results_are_not(program, q, matrix):
    q.flags.writeable = False
    matrix.flags.writeable = False
    one = np.array([1.0])
    v, *_ = program.call("parts", q, matrix, one)
    np.testing.assert_allclose(v, matrix @ q, rtol=1e-14, atol=1e-14)
    out = [np.zeros(s, order="F") for s in [(3,), (7,), (7, 3), (1,), (0, 0)]]
    out[0].flags.writeable = False
    with pytest.raises(LayoutError, match="writeable"):
        program.call("parts", q, matrix, one, out=out)


@pytest.mark.parametrize(
    ("index", "bad", "error", "message"),
    [
        (0, np.zeros(6), ShapeError, r"q: expected shape \(7,\), got \(6,\)"),
        (0, np.zeros((1, 7)), ShapeError, "q: expected shape"),
        (0, [0.0] * 7, ShapeError, "q: expected"),
        (0, np.zeros(7, np.float32), LayoutError, "q: pass dtype float64"),
        (0, np.zeros(7, np.int64), LayoutError, "q: pass dtype float64"),
        (0, np.zeros(14)[::2], LayoutError, "q: pass contiguous"),
        (1, np.zeros((3, 7)), LayoutError, "M: pass contiguous column-major"),
        (1, np.zeros((7, 3), order="F"), ShapeError, "M: expected shape"),
        (2, 1.0, ShapeError, "s: expected shape"),
    ],
)
def test_arrays_that_c_would_misread_are_refused(
    program, q, matrix, index, bad, error, message
):
    arrays = [q, matrix, np.array([1.0])]
    arrays[index] = bad
    with pytest.raises(error, match=message):
        program.call("parts", *arrays)


def test_wrong_counts_and_names_are_refused(program, q, matrix):
    with pytest.raises(ShapeError, match="parts: arrays"):
        program.call("parts", q)
    with pytest.raises(ShapeError, match="parts: out"):
        program.call("parts", q, matrix, np.array([1.0]), out=())
    with pytest.raises(ShapeError, match="parts: arrays"):
        program.map("parts", q, n=1)
    with pytest.raises(RrnnError, match="it has parts"):
        program.call("part", q)


def test_a_bound_call_reads_and_writes_the_same_arrays(program, q, matrix):
    out = [np.zeros(s, order="F") for s in [(3,), (7,), (7, 3), (1,), (0, 0)]]
    run = program.bind("parts", q, matrix, np.array([2.0]), out=out)
    for k in range(3):
        q[:] = np.linspace(-1, k, 7)
        run()
        np.testing.assert_allclose(out[0], matrix @ q, rtol=1e-14, atol=1e-14)
        np.testing.assert_allclose(out[1], 2 * np.sin(q), rtol=1e-15)
    with pytest.raises(ShapeError, match="q: expected"):
        program.bind("parts", q[:6], matrix, np.array([2.0]), out=out)
    with pytest.raises(ShapeError, match="parts: out"):
        program.bind("parts", q, matrix, np.array([2.0]), out=out[:2])


def test_map_runs_over_rows(program, matrix):
    rows = np.random.default_rng(0).normal(size=(50, 7))
    v, w, t, r, _ = program.map("parts", rows, matrix, np.arange(50.0)[:, None], n=50)
    np.testing.assert_allclose(v, rows @ matrix.T, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(w, np.sin(rows) * np.arange(50)[:, None], rtol=1e-14)
    assert t.shape == (50, 7, 3)
    np.testing.assert_array_equal(t[49], matrix.T)
    np.testing.assert_array_equal(r[:, 0], np.arange(50))


def test_map_of_no_rows_is_empty(program, matrix):
    v, *_ = program.map("parts", np.zeros((0, 7)), matrix, np.array([1.0]), n=0)
    assert v.shape == (0, 3)


@pytest.mark.parametrize(
    ("bad", "error"),
    [
        (np.zeros((4, 7)), ShapeError),
        (np.zeros((5, 6)), ShapeError),
        (np.zeros((5, 7), np.float32), LayoutError),
        (np.zeros((7, 5)).T, LayoutError),
        (np.zeros((10, 7))[::2], LayoutError),
    ],
)
def test_rows_that_c_would_misread_are_refused(program, matrix, bad, error):
    with pytest.raises(error):
        program.map("parts", bad, matrix, np.array([1.0]), n=5)


def test_programs_with_the_same_names_do_not_meet():
    def make(k):
        return ca.Function("step", [Q], [Q + k], ["q"], ["y"])

    one = emit.compile(make(1), name="same")
    two = emit.compile(make(2), name="same")
    assert one.built.path != two.built.path
    for _ in range(2):
        for program, k in ((one, 1), (two, 2)):
            np.testing.assert_array_equal(program.call("step", np.zeros(7))[0], [k] * 7)


def test_the_same_program_is_compiled_once(cold_cache):
    assert not emit.compile(FUNCTION, name="demo").built.cached
    assert emit.compile(FUNCTION, name="demo").built.cached


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="needs nm")
def test_only_prefixed_names_are_exported(program):
    command = ["nm", "-D", "--defined-only", str(program.built.path)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    names = {line.split()[-1] for line in done.stdout.splitlines()}
    assert names == {"demo_parts", "demo_parts_map"}


def test_no_library_function_but_sqrt_is_needed(cold_cache):
    fn = ca.Function("f", [Q], [ca.sin(Q) / ca.sqrt(1 + Q**2)], ["q"], ["y"])
    program = emit.compile(fn, name="freestanding")
    command = ["nm", "-D", "--undefined-only", str(program.built.path)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    strong = [line.split()[-1] for line in done.stdout.splitlines() if " U " in line]
    assert {name.split("@")[0] for name in strong} <= {"sqrt"}


def test_programs_need_functions_with_different_names():
    with pytest.raises(RrnnError, match="at least one"):
        emit.compile([])
    with pytest.raises(RrnnError, match="different names"):
        emit.compile([FUNCTION, FUNCTION])
    with pytest.raises(RrnnError, match="identifier"):
        emit.compile(FUNCTION, name="no name")


TRAP = """
import casadi as ca, numpy as np
from rrnn_opt import emit
x = ca.SX.sym('x')
f = ca.Function('f', [x], [ca.sin(x), ca.cos(x)], ['x'], ['s', 'c'])
flags = ['-fsanitize=undefined,float-cast-overflow']
flags += ['-fsanitize-undefined-trap-on-error']
p = emit.compile(f, name='trap', real=REAL, flags=flags)
t = p.entries['f'].inputs[0].dtype
bits = np.frombuffer(np.random.default_rng(0).bytes(80000), t)
xs = np.concatenate([bits, np.array([np.nan, np.inf, -np.inf], t)])
s, c = p.map('f', xs[:, None], n=len(xs))
small = np.abs(xs) < 3e4
assert (np.abs(s[small]) <= 1).all() and (np.abs(c[small]) <= 1).all()
assert np.isnan(s[~(np.abs(xs) <= 2.0**30)]).all()
print('ok')
"""


@pytest.mark.parametrize("real", ["double", "float"])
def test_undefined_behaviour_is_absent_for_any_bits(cold_cache, real):
    """The object traps on undefined behaviour, so a bad cast kills the child."""
    code = f"REAL = '{real}'\n{TRAP}"
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout.strip()) == (0, "ok"), done.stderr


@pytest.mark.slow
def test_the_ziglang_wheel_compiles_the_same_bits(
    cold_cache, monkeypatch, tame_functions
):
    if not _zig():
        pytest.skip("ziglang is not installed")
    exact = ca.Function("f", [Q], [ca.sin(Q) / ca.sqrt(1 + Q**2)], ["q"], ["y"])
    with_gcc = emit.compile([exact, *tame_functions], name="both")
    monkeypatch.setenv("CC", " ".join(_zig()))
    with_zig = emit.compile([exact, *tame_functions], name="both")
    assert "clang" in with_zig.built.compiler
    rows = np.random.default_rng(0).uniform(-9, 9, (1000, 7))
    ours, theirs = (p.map("f", rows, n=1000)[0] for p in (with_gcc, with_zig))
    assert (ours == theirs).all()
