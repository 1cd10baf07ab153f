"""The loop to rest in C, its twin in the interpreter, and when both stop."""

import numpy as np
import pytest

from rrnn_opt.errors import CompilerError
from rrnn_opt.solving import network as network_module
from rrnn_opt.solving.network import RestableNetwork


def test_without_a_compiler_the_interpreter_does_the_same(
    network, posture, monkeypatch
):
    compiled = RestableNetwork.of(network)
    assert compiled.compiled is not None

    def nothing(*args, **kwargs):
        raise CompilerError("no C compiler")

    monkeypatch.setattr(network_module.emit, "build", nothing)
    plain = RestableNetwork.of(network)
    assert plain.compiled is None
    values = [posture.reshape(7, 1), np.array([[0.1], [0.0], [0.1]])]
    start = np.zeros(10)
    runs = [
        n.run(start, values, step=0.005, tolerance=1e-6, max_steps=300)
        for n in (compiled, plain)
    ]
    assert runs[0].steps == runs[1].steps > 50
    np.testing.assert_allclose(runs[0].state, runs[1].state, atol=1e-12)
    assert runs[0].residual == pytest.approx(runs[1].residual, rel=1e-6)
    assert not start.any()


def test_the_loop_stops_at_once_when_already_at_rest(network, posture):
    plain = RestableNetwork.of(network)
    values = [posture.reshape(7, 1), np.zeros((3, 1))]
    run = plain.run(np.zeros(10), values, step=0.001, tolerance=1e-12, max_steps=9)
    assert (run.steps, run.residual) == (0, 0.0)


def test_a_state_that_is_not_finite_stops_the_loop(network, posture):
    plain = RestableNetwork.of(network)
    values = [posture.reshape(7, 1), np.zeros((3, 1))]
    run = plain.run(
        np.full(10, np.nan), values, step=0.001, tolerance=1e-9, max_steps=100
    )
    assert run.steps == 0
    assert not run.residual <= 1e-9
