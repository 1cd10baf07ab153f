from dataclasses import replace

import casadi as ca
import numpy as np
import pytest
import qpsolvers
from scipy.integrate import solve_ivp

import rrnn_opt as rr
from rrnn_opt.errors import CompilerError, ProblemError, RobotError, RrnnError
from rrnn_opt.formulations import minimum_velocity, position_feedback
from rrnn_opt.networks import PrimalDual
from rrnn_opt.simulation import Curve, machine
from rrnn_opt.simulation.simulate import simulate
from rrnn_opt.symbolic import Symbol


def plant(robot):
    kin = rr.Kinematics(robot)
    outputs = [kin.position(), kin.jacobian()]
    fn = ca.Function("plant", [kin.q], outputs)

    def measure(q):
        tip, jacobian = fn(q)
        return np.asarray(tip).ravel(), np.asarray(jacobian)

    return measure


def box(robot, q):
    limits = robot.limits
    upper = np.minimum(limits.velocity, 0.5 * (limits.upper - q))
    lower = np.maximum(-limits.velocity, 0.5 * (limits.lower - q))
    return lower, upper


def test_reduced_position_feedback_is_the_projected_law(pa10, circle):
    """q+ = q + dt P(J'e / eps), by numpy alone."""
    result = simulate(position_feedback, pa10, circle(duration=2.0))
    measure, q = plant(pa10), result.task.q0
    for k in range(result.steps):
        tip, jacobian = measure(q)
        u = np.clip(jacobian.T @ (result.reference[k] - tip) / 0.01, *box(pa10, q))
        np.testing.assert_allclose(result.command[k], u, atol=1e-7)
        np.testing.assert_allclose(result.tip[k], tip, atol=1e-9)
        q = q + 0.01 * u
    np.testing.assert_allclose(result.q[-1], q, atol=1e-7)


def test_reduced_minimum_velocity_is_the_qp_s_optimum(pa10, circle):
    task = circle(duration=10.0, kappa=20.0)
    result = simulate(minimum_velocity, pa10, task)
    assert result.record.unsettled == 0
    form = minimum_velocity(rr.Kinematics(pa10))
    measure = plant(pa10)
    rate = np.gradient(result.reference, result.t, axis=0, edge_order=2)
    for k in (100, 400, 777):
        q = result.q[k]
        error = result.reference[k] - measure(q)[0]
        problem = form.qp.at(q=q, rd_dot=rate[k] + 20.0 * error)
        want = qpsolvers.solve_problem(problem, solver="quadprog").x
        np.testing.assert_allclose(result.command[k], want, atol=1e-4)
        np.testing.assert_allclose(result.q[k + 1], q + 0.01 * result.command[k])


def test_the_literal_law_is_the_second_order_equation_17(pa10, circle):
    """Against a stiff integrator on eps u' = -u + P(J'e / eps), q' = u."""
    task = circle(duration=1.5, dt=2e-4, law="literal", steps=1)
    result = simulate(position_feedback, pa10, task)
    measure = plant(pa10)
    start = measure(task.q0)[0]

    def slope(t, x):
        q, u = x[:7], x[7:]
        phi = 2 * np.pi * np.sin(np.pi * t / 20.0) ** 2
        rd = start + 0.15 * np.array([0.0, 1 - np.cos(phi), np.sin(phi)])
        tip, jacobian = measure(q)
        drive = np.clip(jacobian.T @ (rd - tip) / 0.01, *box(pa10, q))
        return np.concatenate([u, (-u + drive) / 0.01])

    x0 = np.concatenate([task.q0, np.zeros(7)])
    exact = solve_ivp(slope, (0.0, 1.5), x0, method="LSODA", rtol=1e-7, atol=1e-9)
    np.testing.assert_allclose(result.q[-1], exact.y[:7, -1], atol=2e-4)
    np.testing.assert_allclose(result.command[-1], exact.y[7:, -1], atol=2e-3)


@pytest.mark.parametrize(
    ("scheme", "kappa", "sigma", "rms_mm"),
    [
        (position_feedback, 0.0, 0.01, 5.6),
        (position_feedback, 0.0, 0.05, 5.6),
        (position_feedback, 0.0, 0.25, 6.6),
        (minimum_velocity, 0.0, 0.01, 2.9),
        (minimum_velocity, 0.0, 0.05, 14.2),
        (minimum_velocity, 0.0, 0.25, 70.7),
        (minimum_velocity, 20.0, 0.05, 1.1),
        (minimum_velocity, 20.0, 0.25, 5.6),
    ],
)
def test_lag_and_drift_are_those_of_an_earlier_trial(
    pa10, circle, scheme, kappa, sigma, rms_mm
):
    """Feedback lags and shrugs off noise; open loop drifts with it."""
    runs = [
        simulate(scheme, pa10, circle(sigma=sigma, seed=seed, kappa=kappa))
        for seed in range(3)
    ]
    got = 1e3 * np.mean([run.rms_error_m for run in runs])
    assert got == pytest.approx(rms_mm, rel=0.06)
    assert all(run.limits_kept for run in runs)


def test_a_seed_makes_the_run(pa10, circle):
    def run(seed):
        return simulate(position_feedback, pa10, circle(sigma=0.1, seed=seed)).q

    np.testing.assert_array_equal(run(3), run(3))
    assert np.abs(run(3) - run(4)).max() > 1e-6


def test_where_the_noise_enters(pa10, circle):
    runs = {
        enters: simulate(
            minimum_velocity,
            pa10,
            circle(sigma=0.05, enters=enters, duration=3.0, kappa=5.0),
        )
        for enters in ("joint_velocity", "task_velocity", "acceleration")
    }
    behind = {name: run.qd - run.command for name, run in runs.items()}
    draws = 0.05 * np.random.default_rng(0).standard_normal((301, 7))
    np.testing.assert_allclose(behind["joint_velocity"], draws, atol=1e-15)
    walk = 0.01 * np.cumsum(draws, axis=0)
    np.testing.assert_allclose(behind["acceleration"], walk, atol=1e-15)
    assert not behind["task_velocity"].any()
    quiet = simulate(minimum_velocity, pa10, circle(duration=3.0, kappa=5.0))
    assert np.abs(runs["task_velocity"].q - quiet.q).max() > 1e-4


def test_a_target_beyond_a_stop_is_not_reached_but_limits_hold(pa10, circle):
    task = circle(duration=8.0)
    curve = Curve("point", 8.0, 8.0, position=np.array([0.0, 0.0, -0.3]))
    result = simulate(position_feedback, pa10, replace(task, curve=curve))
    assert result.limits_kept
    assert result.max_error_m > 0.5


def test_a_task_that_does_not_fit_is_refused(pa10, circle):
    task = circle()
    with pytest.raises(ProblemError, match=r"robot\.q0:"):
        simulate(position_feedback, pa10, replace(task, q0=np.zeros(3)))
    outside = task.q0.copy()
    outside[1] = 3.0
    with pytest.raises(ProblemError, match=r"robot\.q0\[1\].*outside"):
        simulate(position_feedback, pa10, replace(task, q0=outside))
    with pytest.raises(RobotError, match="no_such"):
        simulate(position_feedback, pa10, replace(task, frame="no_such"))
    with pytest.raises(ProblemError, match=r"control\.kappa"):
        simulate(position_feedback, pa10, circle(kappa=3.0))
    with pytest.raises(ProblemError, match=r"noise\.enters"):
        simulate(position_feedback, pa10, circle(sigma=0.1, enters="task_velocity"))
    with pytest.raises(ProblemError, match="no scheme 'fastest'"):
        simulate("fastest", pa10, task)


def test_a_signal_that_the_loop_has_not_is_named(pa10, circle):
    def torques(kin):
        weather = Symbol.vector("weather", 1)
        form = position_feedback(kin)
        return replace(form, parameters=(*form.parameters, weather))

    with pytest.raises(RrnnError, match="weather"):
        simulate(torques, pa10, circle())


def test_an_output_that_is_no_joint_quantity_is_refused(pa10, circle):
    def short(form):
        network = PrimalDual()(form)
        return replace(network, output=network.output[:3])

    with pytest.raises(RrnnError, match="joint quantity"):
        simulate(position_feedback, pa10, circle(), network=short)


def test_a_diverging_run_says_so(pa10, circle):
    task = circle(law="literal", dt=0.05, steps=1, duration=60.0)
    with pytest.raises(RrnnError, match="diverges"):
        simulate(position_feedback, pa10, task)


def test_too_few_steps_are_counted(pa10, circle):
    result = simulate(minimum_velocity, pa10, circle(steps=1, duration=1.0))
    assert result.record.unsettled > 50
    assert result.to_dict()["unsettled"] == result.record.unsettled


def test_without_a_compiler_it_says_what_to_install(pa10, circle, monkeypatch):
    def nothing(*args, **kwargs):
        raise CompilerError("no C compiler: install gcc")

    monkeypatch.setattr(machine.emit, "build", nothing)
    with pytest.raises(CompilerError, match="install"):
        simulate(position_feedback, pa10, circle(epsilon=0.0123))


def test_another_robot(circle):
    robot = rr.Robot.builtin("planar3")
    task = replace(
        circle(duration=4.0),
        q0=np.array([0.3, 0.8, -0.6]),
        curve=Curve("line", 4.0, 4.0, offset=np.array([-0.2, 0.1, 0.0])),
    )
    result = simulate(minimum_velocity, robot, task)
    assert result.limits_kept
    assert result.record.unsettled == 0
    assert result.max_error_m < 2e-3


def test_top_level_verb():
    assert rr.simulate is simulate
