"""Text for microcontrollers computes the bits of the host's, sines in a loop."""

import ctypes

import casadi as ca
import numpy as np
import pytest

from rrnn_opt import emit
from rrnn_opt.emit import c_function, prologue
from rrnn_opt.symbolic.interpreter import evaluate, sincos
from rrnn_opt.symbolic.tape import Tape
from tests.emit.test_sincos import LIMITS, points

PAIRS = """
RRNN_EXPORT void pairs(size_t n, const real_t *x, real_t *s, real_t *c);
void pairs(size_t n, const real_t *x, real_t *s, real_t *c)
{
    for (size_t k = 0; k < n; ++k) {
        const rrnn_sincos_t both = rrnn_sincos(x[k]);
        s[k] = both.s;
        c[k] = both.c;
    }
}
"""


def loaded(source):
    return emit.load(emit.build(source, name="compact"))


def pointer(array):
    return ctypes.c_void_p(array.ctypes.data)


@pytest.mark.parametrize("real", LIMITS)
def test_sine_and_cosine_have_the_same_bits(real):
    dtype, limit = LIMITS[real]
    x = points(dtype)
    edge = [limit, -limit, np.nextafter(dtype(limit), dtype(np.inf)), 3e9, -3e30]
    edge += [np.inf, -np.inf, np.nan, 0.0, -0.0, np.finfo(dtype).smallest_subnormal]
    x = np.concatenate([x, x * dtype(limit / 50), np.array(edge, dtype)])
    s, c = np.empty_like(x), np.empty_like(x)
    library = loaded(prologue(real, compact=True) + PAIRS)
    library["pairs"](ctypes.c_size_t(len(x)), *map(pointer, (x, s, c)))
    for ours, theirs in zip((s, c), sincos(x), strict=True):
        np.testing.assert_array_equal(ours, theirs)
        known = ~np.isnan(theirs)
        assert (np.signbit(ours) == np.signbit(theirs))[known].all()


def functions():
    q, shift = ca.SX.sym("q", 4), ca.SX.sym("shift")
    first = ca.sin(q[1]) * ca.cos(q[2]) + ca.sin(q[3] + shift)
    return {
        "in order": ca.Function("f", [q, shift], [first + q[2]], ["q", "d"], ["r"]),
        "only turned": ca.Function(
            "f", [shift, q], [ca.sin(ca.vertcat(q[0], q[1]))], ["d", "q"], ["r"]
        ),
        "scattered": ca.Function(
            "f", [q, shift], [ca.cos(q[3]) * ca.sin(shift)], ["q", "d"], ["r"]
        ),
        "one angle": ca.Function("f", [q, shift], [ca.cos(q[3])], ["q", "d"], ["r"]),
    }


@pytest.mark.parametrize("name", functions())
@pytest.mark.parametrize("real", LIMITS)
def test_functions_have_the_bits_of_the_tape(name, real):
    tape, dtype = Tape.of(functions()[name]), LIMITS[real][0]
    text = c_function(tape, "compact_f", real=real, static=False, compact=True)
    library = loaded(prologue(real, compact=True) + text)
    assert text.count("rrnn_sincos(") + text.count("rrnn_sincos_all(") <= 2
    rng = np.random.default_rng(3)
    given = [rng.uniform(-3, 3, port.size).astype(dtype) for port in tape.inputs]
    out = np.empty(tape.outputs[0].size, dtype)
    library["compact_f"](*map(pointer, (*given, out)))
    np.testing.assert_array_equal(out, evaluate(tape, given, dtype)[0][:, 0])
