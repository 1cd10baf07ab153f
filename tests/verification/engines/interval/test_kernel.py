"""Enclosures of the compiled kernel and of the checker against ball arithmetic."""

from __future__ import annotations

import casadi as ca
import flint
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from benchmarks.interval_soundness.run import batch
from rrnn_opt.errors import ShapeError, UnsupportedOperationError
from rrnn_opt.verification.engines.interval.kernel import IntervalKernel


@pytest.fixture(scope="module")
def waves() -> IntervalKernel:
    x = ca.SX.sym("x")
    return IntervalKernel.of(ca.Function("f", [x], [ca.sin(x), ca.cos(x)]))


def test_no_value_of_a_random_graph_is_outside():
    outside, bounded = batch(0, graphs=2, count=60)
    assert outside == 0
    assert bounded > 60


@pytest.mark.slow
@settings(max_examples=20)
@given(st.integers(1, 10**6))
def test_five_thousand_random_graphs_and_boxes(seed):
    outside, _ = batch(10**6 + seed, graphs=1, count=250)
    assert outside == 0


@given(st.floats(-1e5, 1e5), st.floats(0.0, 10.0))
@settings(max_examples=200)
def test_waves_hold_ends_and_crests(waves, start, width):
    low, high = np.array([[start]]), np.array([[start + width]])
    found = waves(low, high)
    with flint.ctx.workprec(200):
        for point in (start, start + width, start + width / 2, start + width / 3):
            if point > start + width:
                continue
            for k, value in enumerate((flint.arb(point).sin(), flint.arb(point).cos())):
                assert not value < found.lower[k, 0]
                assert not value > found.upper[k, 0]
        turns = flint.arb(start).union(flint.arb(start + width)) / (2 * flint.arb.pi())
        for k, shift in enumerate((flint.arb(1) / 4, flint.arb(0))):
            crest = turns - shift
            if crest.lower().floor() != crest.upper().floor():
                assert found.upper[k, 0] == 1.0


def test_waves_are_as_narrow_as_the_stated_error(waves):
    points = np.random.default_rng(0).uniform(-100, 100, (1, 1000))
    found = waves(points, points)
    assert np.all(found.upper - found.lower <= 2.0**-47)


def test_far_angles_and_whole_turns_give_the_whole_range(waves):
    low = np.array([[2e5, 0.0, -1e300]])
    high = np.array([[2e5, 7.0, 1e300]])
    found = waves(low, high)
    assert np.all(found.lower == -1.0)
    assert np.all(found.upper == 1.0)


def test_what_is_not_defined_is_not_bounded():
    x = ca.SX.sym("x")
    function = ca.Function("f", [x], [ca.fmin(1 / x, 0.0)])
    kernel = IntervalKernel.of(function)
    found = kernel(np.array([[-1.0, 1.0, 1e-320]]), np.array([[1.0, 2.0, 1.0]]))
    assert found.bounded.tolist() == [False, True, False]
    overflow = IntervalKernel.of(ca.Function("g", [x], [ca.fmin(x * x, 0.0)]))
    assert not overflow(np.array([[1e200]]), np.array([[1e200]])).bounded[0]


def test_wrong_rows_and_unknown_operations_are_refused(waves):
    with pytest.raises(ShapeError):
        waves(np.zeros((2, 4)), np.zeros((2, 4)))
    x = ca.SX.sym("x")
    with pytest.raises(UnsupportedOperationError, match="atan2"):
        IntervalKernel.of(ca.Function("f", [x], [ca.atan2(x, 1)]))


@pytest.mark.parametrize("constant", [np.inf, -np.inf, np.nan])
def test_a_constant_that_is_no_number_is_refused(constant):
    x = ca.SX.sym("x")
    with pytest.raises(UnsupportedOperationError, match="interval engine"):
        IntervalKernel.of(ca.Function("f", [x], [ca.sin(x) + constant]))
