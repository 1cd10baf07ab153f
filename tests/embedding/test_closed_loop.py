"""A generated controller against the simulated arm at 1 kHz, beside the model."""

from __future__ import annotations

import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.dynamics import Euler
from rrnn_opt.embedding import generate

PERIOD, RADIUS, TICK = 3.0, 0.1, 1e-3
STEP = 0.0035
START = np.array([0.0, 0.3, 0.0, -1.9, 0.0, 2.2, 0.8])


def circle(centre, t):
    """Position and velocity on a circle in y, z that starts and ends at rest."""
    s = t / PERIOD
    phase = 2 * np.pi * s**3 * (10 - 15 * s + 6 * s**2)
    rate = 2 * np.pi / PERIOD * 30 * s**2 * (1 - s) ** 2
    way = np.array([0.0, np.sin(phase), 1.0 - np.cos(phase)])
    speed = rate * np.array([0.0, np.cos(phase), np.sin(phase)])
    return centre + RADIUS * way, RADIUS * speed


def errors(position, law):
    """Distance to the circle after every tick, m; q' is the controller's output."""
    q = START.copy()
    centre = np.asarray(position(q)).ravel()
    found = []
    for k in range(round(PERIOD / TICK)):
        rd, rd_dot = circle(centre, k * TICK)
        q = q + TICK * law(q, rd_dot, rd)
        wanted, _ = circle(centre, (k + 1) * TICK)
        found.append(np.linalg.norm(np.asarray(position(q)).ravel() - wanted))
    return np.array(found)


@pytest.fixture(scope="module")
def loop():
    kin = rr.Kinematics(rr.Robot.builtin("panda"))
    form = rr.formulations.closed_loop(kin)
    rule = rr.networks.LviPdnn(whiten=True)
    dynamics = rule(form)
    step = dynamics.step(Euler(STEP)).functions()["step"]
    state = np.zeros(dynamics.state.size)

    def model(q, rd_dot, rd):
        nonlocal state
        state = np.asarray(step(state, q, rd_dot, rd)[0]).ravel()
        return state[:7]

    position = kin.functions()["position"]
    return kin, rule, dynamics, position, errors(position, model)


@pytest.mark.parametrize("real", ["float", "double"])
def test_one_network_step_a_tick_keeps_the_circle(loop, controller, tmp_path, real):
    kin, rule, dynamics, position, model = loop
    package = generate(
        dynamics, network=rule, kinematics=kin, step_size=STEP, real=real
    )
    _, arm = controller(package, tmp_path, tolerance=1e9)
    assert arm.selftest() == 0

    def law(q, rd_dot, rd):
        return np.array(arm.step(q=q, rd_dot=rd_dot, rd=rd))

    own = errors(position, law)
    assert own.max() <= 0.25e-3
    assert own.max() == pytest.approx(model.max(), rel=0.05)
    assert arm.out.verdict & 16 == 0


def test_the_exact_solver_comes_nearer(loop, controller, tmp_path):
    _, rule, dynamics, position, model = loop
    package = generate(dynamics, network=rule, step_size=STEP)
    _, arm = controller(package, tmp_path, tolerance=1e-3)
    answered = 0

    def law(q, rd_dot, rd):
        nonlocal answered
        output = arm.step(q=q, rd_dot=rd_dot, rd=rd)
        answered += bool(arm.out.verdict & 16)
        return np.array(output)

    assert errors(position, law).max() < 0.5 * model.max()
    assert 0 < answered < 3000


def test_monitor_and_python_module(loop, controller, tmp_path):
    kin, rule, dynamics, position, _ = loop
    package = generate(
        dynamics, network=rule, kinematics=kin, step_size=STEP, real="double"
    )
    module, arm = controller(package, tmp_path, tolerance=1e-6)
    assert arm.model_hash == package.manifest["model_hash"]
    rd = np.asarray(position(START)).ravel()
    given = {"q": START, "rd_dot": [0.0, 0.1, 0.0], "rd": rd}
    seen = arm.monitor(**given)
    assert seen.verdict & 1
    assert seen.merit == pytest.approx(0.5 * seen.residual**2, rel=0.5)
    before = seen.merit
    arm.step(**given)  # no residual is allowed: the exact solver answers
    assert arm.out.verdict & 16
    settled = arm.monitor(**given)
    assert settled.residual < 1e-12
    assert settled.verdict & 1 == 0
    with pytest.raises(module.Refused, match="step too long"):
        module.Controller(tmp_path / "arm.so", step_size=0.1)
    with pytest.raises(module.Refused, match="not finite"):
        arm.step(**(given | {"rd": [np.nan, 0.0, 0.0]}))
    arm.state.tolerance = 1e9
    arm.state.state[:] = [0.0] * len(arm.state.state)
    arm.step(**given)
    fallen = arm.monitor(**given).merit - before
    assert fallen == pytest.approx(seen.merit_change, rel=1e-9)
