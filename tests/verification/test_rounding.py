"""Rounding bounds against what the emitted arithmetic is really off by."""

from __future__ import annotations

import casadi as ca
import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.errors import RrnnError, ShapeError, UnsupportedOperationError
from rrnn_opt.symbolic.interpreter import evaluate
from rrnn_opt.symbolic.tape import Tape
from rrnn_opt.verification.rounding import rounding_bound


def measured(tape: Tape, box, count: int = 4000) -> list[np.ndarray]:
    """Largest difference between float and double arithmetic on float inputs."""
    rng = np.random.default_rng(0)
    inputs = []
    for port in tape.inputs:
        low, high = (np.broadcast_to(x, (port.size,)) for x in box[port.name])
        draws = rng.uniform(low[:, None], high[:, None], (port.size, count))
        cut = np.clip(np.float32(draws), np.float32(low)[:, None], None)
        inputs.append(cut.reshape(port.shape[1], port.shape[0], count).swapaxes(0, 1))
    single = evaluate(tape, inputs, np.float32)
    double = evaluate(tape, [np.float64(x) for x in inputs])
    pairs = zip(single, double, strict=True)
    return [np.abs(np.float64(a) - b).max(axis=-1) for a, b in pairs]


@pytest.mark.parametrize("name", ["planar3", "pa10"])
def test_jacobian_stays_within_its_bound(name):
    kin = rr.Kinematics(rr.Robot.builtin(name))
    tape = Tape.of(kin.functions()["jacobian"])
    box = {"q": (-1.0, 1.0)}
    (bound,), (seen,) = rounding_bound(tape, box), measured(tape, box)
    assert np.all(seen <= bound)
    assert bound.max() < 3e-5
    assert bound.max() < 100 * seen.max()


def test_one_control_step_stays_within_its_bound():
    kin = rr.Kinematics(rr.Robot.builtin("pa10"))
    dynamics = rr.networks.PrimalDual(epsilon=0.01)(
        rr.formulations.minimum_velocity(kin)
    )
    tape = Tape.of(dynamics.step(rr.Euler(0.001)).functions()["step"])
    wide = {"q": (-0.5, 0.5), "rd_dot": (-0.1, 0.1)}
    box = {port.name: wide.get(port.name, (-1.0, 1.0)) for port in tape.inputs}
    bounds, seen = rounding_bound(tape, box), measured(tape, box)
    for bound, error in zip(bounds, seen, strict=True):
        assert np.all(np.isfinite(bound))
        assert np.all(error <= bound)
        assert bound.max() < 1e-4


def test_double_is_five_hundred_million_times_better():
    kin = rr.Kinematics(rr.Robot.builtin("planar3"))
    tape = Tape.of(kin.functions()["position"])
    box = {"q": (-1.0, 1.0)}
    (single,) = rounding_bound(tape, box)
    (double,) = rounding_bound(tape, box, "double")
    assert single.max() / double.max() == pytest.approx(2.0**29, rel=0.5)


def test_what_has_no_bound_is_infinite():
    x = ca.SX.sym("x")
    divided = ca.Function("f", [x], [1 / x, ca.sqrt(x), ca.sin(x)], ["x"], list("abc"))
    a, b, c = rounding_bound(divided, {"x": (-1.0, 200.0)})
    assert np.all(np.isinf([a, b, c]))


def test_a_comparison_that_rounding_may_turn_costs_its_jump():
    x = ca.SX.sym("x")
    step = ca.Function("f", [x], [x * 1.1 < 0.55], ["x"], ["y"])
    (unsure,) = rounding_bound(step, {"x": (0.0, 1.0)})
    (sure,) = rounding_bound(step, {"x": (0.6, 1.0)})
    assert unsure[0, 0] == 1.0
    assert sure[0, 0] == 0.0


def test_bad_input_is_refused():
    x = ca.SX.sym("x", 2)
    f = ca.Function("f", [x], [ca.sum1(x)], ["x"], ["y"])
    with pytest.raises(RrnnError, match="no bounds for 'x'"):
        rounding_bound(f, {})
    with pytest.raises(ShapeError):
        rounding_bound(f, {"x": (np.zeros(3), np.ones(3))})
    with pytest.raises(RrnnError, match="finite"):
        rounding_bound(f, {"x": (0.0, np.inf)})
    g = ca.Function("g", [x], [ca.exp(x)], ["x"], ["y"])
    with pytest.raises(UnsupportedOperationError):
        rounding_bound(g, {"x": (0.0, 1.0)})
