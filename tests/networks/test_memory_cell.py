"""The memory cell (14): exact flow against an ODE solver, bounds, ceilings."""

import casadi as ca
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from rrnn_opt.errors import RrnnError
from rrnn_opt.networks import MemoryCell

UNIT = st.floats(0.0, 1.0)


def flow(cell: MemoryCell, x: float, stimulus: float) -> float:
    return float(cell.function()(x, stimulus))


@settings(max_examples=60)
@given(UNIT, UNIT, st.floats(0.1, 2.0), st.floats(0.1, 2.0), st.floats(0.05, 3.0))
def test_flow_is_the_solution_of_the_differential_equation(x, i, decay, w, duration):
    if abs(decay - w) < 1e-2:
        w = decay + 0.05
    cell = MemoryCell(decay, w, duration)
    state, stimulus = ca.SX.sym("x"), ca.SX.sym("i")
    slope = ca.Function("f", [state, stimulus], [cell.derivative(state, stimulus)])
    answer = solve_ivp(
        lambda _, y: [float(slope(y[0], i))],
        (0.0, duration),
        [x],
        method="LSODA",
        rtol=1e-10,
        atol=1e-12,
    )
    assert flow(cell, x, i) == pytest.approx(answer.y[0, -1], abs=1e-7)


@settings(max_examples=200)
@given(UNIT, UNIT)
def test_activity_stays_in_the_unit_interval(x, stimulus):
    assert 0.0 <= flow(MemoryCell(), x, stimulus) <= 1.0


def test_two_half_steps_make_one():
    whole, half = MemoryCell(duration=1.0), MemoryCell(duration=0.5)
    assert flow(half, flow(half, 0.3, 1.0), 1.0) == pytest.approx(
        flow(whole, 0.3, 1.0), abs=1e-14
    )


def test_ceiling_and_rest_of_the_paper_s_parameters():
    cell, x = MemoryCell(), 0.0
    for _ in range(60):
        x = flow(cell, x, 1.0)
    # root of w x^2 + (A + 1 - w) x - 1 = 0
    assert x == pytest.approx(max(np.roots([0.95, 0.95, -1.0])), abs=1e-12)
    for _ in range(600):
        x = flow(cell, x, 0.0)
    assert x == pytest.approx(1.0 - 0.9 / 0.95, abs=1e-9)


@pytest.mark.parametrize("bad", [(0.0, 0.95), (0.9, -1.0), (0.9, 0.9)])
def test_parameters_out_of_range_are_refused(bad):
    with pytest.raises(RrnnError, match="memory cell"):
        MemoryCell(*bad)
