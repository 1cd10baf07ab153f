"""The compiled sine and cosine: to the bit, and against extended precision."""

import casadi as ca
import numpy as np
import pytest

from rrnn_opt import emit
from rrnn_opt.symbolic.interpreter import sincos

X = ca.SX.sym("x")
FUNCTION = ca.Function("pair", [X], [ca.sin(X), ca.cos(X)], ["x"], ["s", "c"])
LIMITS = {"double": (np.float64, 2.0**30), "float": (np.float32, 2.0**15)}


def compiled(real, x):
    program = emit.compile(FUNCTION, name=f"trig_{real}", real=real)
    return [r[:, 0] for r in program.map("pair", x[:, None], n=len(x))]


def points(dtype):
    """A spread of numbers, and all neighbours of the multiples of pi/2."""
    spread = np.random.default_rng(5).uniform(-50, 50, 100_000).astype(dtype)
    centres = (np.arange(-31, 32) * (np.pi / 2)).astype(dtype)
    steps = np.arange(-20, 21).astype(dtype)[:, None] * np.spacing(np.abs(centres))
    return np.concatenate([spread, spread * dtype(1e-4), (centres + steps).ravel()])


@pytest.mark.parametrize("real", LIMITS)
def test_c_and_numpy_give_the_same_bits(real):
    dtype, limit = LIMITS[real]
    x = points(dtype)
    x = np.concatenate([x, x * dtype(limit / 50), x * dtype(2 * limit / 50)])
    for ours, theirs in zip(compiled(real, x), sincos(x), strict=True):
        np.testing.assert_array_equal(ours, theirs)


@pytest.mark.parametrize("real", LIMITS)
def test_c_is_within_two_ulp(real):
    dtype, _ = LIMITS[real]
    x = points(dtype)
    wide = x.astype(np.longdouble)
    for ours, exact in zip(
        compiled(real, x), (np.sin(wide), np.cos(wide)), strict=True
    ):
        ulp = np.spacing(np.abs(exact).astype(dtype)).astype(np.longdouble)
        assert np.max(np.abs(ours - exact) / ulp) <= 2


@pytest.mark.parametrize("real", LIMITS)
def test_outside_its_domain_the_answer_is_nan(real):
    dtype, limit = LIMITS[real]
    edge = dtype(limit)
    inside = compiled(real, np.array([edge, -edge]))
    assert all(np.isfinite(result).all() for result in inside)
    beyond = [np.nextafter(edge, dtype(np.inf)), -edge * 2, np.inf, -np.inf, np.nan]
    outside = compiled(real, np.array(beyond, dtype))
    assert all(np.isnan(result).all() for result in outside)
