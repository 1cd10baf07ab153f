"""Emitted C against the numpy interpreter, bit for bit, and against CasADi."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt import emit
from rrnn_opt.symbolic.interpreter import evaluate
from rrnn_opt.symbolic.tape import Tape

DTYPES = {"double": np.float64, "float": np.float32}
plain = st.floats(-4, 4)
odd = st.sampled_from([0.0, -0.0, 1.0, -1.0, 1e-300, 1e300, np.inf, -np.inf, np.nan])


def arrays(numbers, dtype):
    return (
        np.array(numbers[:4], dtype),
        np.asfortranarray(np.array(numbers[4:], dtype).reshape(2, 2)),
    )


@pytest.fixture(scope="module")
def programs(wild_functions, tame_functions):
    functions = [*wild_functions, *tame_functions]
    return {
        real: emit.compile(functions, name=f"graphs_{real}", real=real)
        for real in DTYPES
    }


@pytest.fixture(scope="module")
def tapes(wild_functions):
    return {fn.name(): Tape.of(fn) for fn in wild_functions}


@pytest.mark.parametrize("real", DTYPES)
@settings(max_examples=150)
@given(pick=st.integers(0, 23), numbers=st.lists(plain | odd, min_size=8, max_size=8))
@pytest.mark.filterwarnings("ignore:overflow encountered in cast")
def test_c_equals_numpy_to_the_bit(programs, tapes, real, pick, numbers):
    x, a = arrays(numbers, DTYPES[real])
    name = f"wild{pick}"
    ours = programs[real].call(name, x, a)
    theirs = evaluate(tapes[name], [x, a], DTYPES[real])
    for c_value, value in zip(ours, theirs, strict=True):
        value = value.reshape(c_value.shape)
        both_nan = np.isnan(c_value) & np.isnan(value)
        bits = np.dtype(f"u{value.itemsize}")
        c_bits = np.ascontiguousarray(c_value).view(bits)
        assert (both_nan | (c_bits == np.ascontiguousarray(value).view(bits))).all()


@settings(max_examples=100)
@given(pick=st.integers(0, 9), numbers=st.lists(plain, min_size=8, max_size=8))
def test_c_equals_casadi(programs, tame_functions, pick, numbers):
    x, a = arrays(numbers, np.float64)
    ours = programs["double"].call(f"tame{pick}", x, a)
    theirs = tame_functions[pick](x, np.tril(a))
    for c_value, value in zip(ours, theirs, strict=True):
        wanted = np.array(value).reshape(c_value.shape)
        np.testing.assert_allclose(c_value, wanted, rtol=1e-12, atol=1e-12)


def test_float_code_is_close_to_double_code(programs):
    x, a = arrays(np.linspace(-2, 2, 8), np.float64)
    for k in range(10):
        wide = programs["double"].call(f"tame{k}", x, a)
        narrow = programs["float"].call(
            f"tame{k}", x.astype("f4"), np.asfortranarray(a.astype("f4"))
        )
        for one, other in zip(wide, narrow, strict=True):
            assert other.dtype == np.float32
            np.testing.assert_allclose(other, one, atol=2e-5)


@pytest.mark.parametrize("real", DTYPES)
def test_rows_in_one_loop_equal_single_calls(programs, real):
    rng = np.random.default_rng(3)
    xs = rng.uniform(-2, 2, (9, 4)).astype(DTYPES[real])
    many = rng.uniform(-2, 2, (9, 2, 2)).astype(DTYPES[real])
    a_s = np.swapaxes(np.ascontiguousarray(np.swapaxes(many, 1, 2)), 1, 2)
    vs, ms = programs[real].map("tame3", xs, a_s, n=9)
    held, _ = programs[real].map("tame3", xs, np.asfortranarray(a_s[4]), n=9)
    for k in range(9):
        a = np.asfortranarray(a_s[k])
        v, m = programs[real].call("tame3", xs[k], a)
        assert (vs[k] == v).all()
        assert (ms[k] == m).all()
        fixed, _ = programs[real].call("tame3", xs[k], np.asfortranarray(a_s[4]))
        assert (held[k] == fixed).all()
