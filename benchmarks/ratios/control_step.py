"""One control step of the network beside one warm solve by OSQP and by DAQP.

The stream is the minimum-velocity QP along a tracked circle on the PA10.  A
network step is what runs on a robot in one control period: kinematics, limits,
one Euler step of (6).  It is not a solve: the network follows the optimum over
many periods.  So the table also has the whole solve, settled from the last
period's state, and how far one step a period stays from the optimum.  The
solvers' QP data are computed beforehand and not counted against them; their
times are those of update and solve through their Python wrappers, so they are
compared with the network step as called from Python.
"""

from __future__ import annotations

import numpy as np

import rrnn_opt as rr
from benchmarks.record import Benchmark, Row, seconds_each
from rrnn_opt import emit
from rrnn_opt.simulation import Control, Curve, Task
from rrnn_opt.solving import DaqpSession, Instance, OsqpSession, SettledNetwork
from rrnn_opt.solving.network import restable

EPSILON, PERIOD = 0.01, 0.001
TOLERANCE = 1e-6
LOOSE = {"eps_abs": 1e-6, "eps_rel": 0.0, "max_iter": 20_000}


def stream() -> tuple[rr.NeuralDynamics, list[Instance]]:
    """The network, and the QPs of 250 control periods of 1 ms along a circle."""
    robot = rr.Robot.builtin("pa10")
    kin = rr.Kinematics(robot)
    form = rr.formulations.minimum_velocity(kin)
    task = Task(
        Curve("circle", 4.0, 4.0, radius=0.15),
        np.deg2rad([0.0, 30.0, 0.0, 60.0, 0.0, 45.0, 0.0]),
        control=Control(dt=PERIOD, kappa=20.0),
    )
    run = rr.simulate(rr.formulations.minimum_velocity, robot, task)
    velocity = np.gradient(run.reference, run.t, axis=0)
    instances = []
    for k in range(1000, 1250):
        given = {"q": run.q[k], "rd_dot": velocity[k]}
        instances.append(Instance(form.qp.at(**given), given))
    return rr.networks.PrimalDual(epsilon=EPSILON)(form), instances


def solver_seconds(solver: object, instances: list[Instance]) -> tuple[float, float]:
    """Median time of a warm solve along the stream, and the worst residual."""
    solver.setup(instances[0])
    answers = []
    for instance in instances:
        solver.update(instance)
        answers.append(solver.solve())
    assert all(a.status.has_point for a in answers)
    times = [answer.time_s for answer in answers[1:]]
    return float(np.median(times)), max(a.residual.worst for a in answers)


def settle_seconds(dynamics: rr.NeuralDynamics, instances: list[Instance]) -> float:
    """Median time of settling in C from the last period's state."""
    network = restable(dynamics)
    state, times = np.zeros(dynamics.state.size), []
    for instance in instances:
        values = [instance.parameters[p.name] for p in dynamics.parameters]

        def once(start=state, values=values):
            return network.run(
                start, values, step=0.005, tolerance=TOLERANCE, max_steps=100_000
            )

        times.append(seconds_each(once, calls=1, repeats=3))
        state = once().state
    return float(np.median(times))


def run(benchmark: Benchmark) -> None:
    dynamics, instances = stream()
    program = emit.compile(dynamics.step(rr.Euler(PERIOD)).functions()["step"])
    rows = len(instances)
    q = np.array([i.parameters["q"] for i in instances])
    v = np.array([i.parameters["rd_dot"] for i in instances])
    states = np.zeros((rows, dynamics.state.size))
    step = seconds_each(lambda: program.map("step", states, q, v, n=rows), calls=20)
    one = [states[0].copy(), q[0].copy(), v[0].copy()]
    out = program.call("step", *one)
    called = seconds_each(lambda: program.call("step", *one, out=out), calls=2000)
    loose = OsqpSession(settings=LOOSE, tolerance=1e-4)
    osqp, osqp_left = solver_seconds(loose, instances)
    daqp, daqp_left = solver_seconds(DaqpSession(), instances)
    settled = settle_seconds(dynamics, instances)
    base = step / rows
    benchmark.add(
        Row("one network step, in C", base, "s"),
        Row("one network step, called from Python", called, "s", called / base),
        Row("the QP's data alone, in C", data_seconds(dynamics, q, v), "s"),
        Row("network settled to 1e-6, warm, in C", settled, "s", settled / base),
        Row("OSQP, warm, eps 1e-6", osqp, "s", osqp / called),
        Row("DAQP, warm", daqp, "s", daqp / called),
        Row("OSQP: worst KKT residual", osqp_left, "1"),
        Row("DAQP: worst KKT residual", daqp_left, "1"),
        Row(
            "one step a period: largest distance from the optimum",
            following(dynamics, instances),
            "rad/s",
        ),
    )


def data_seconds(dynamics: rr.NeuralDynamics, q: np.ndarray, v: np.ndarray) -> float:
    """P, q, A, b, G, h, lb and ub, which a solver needs before it can start."""
    program = emit.compile(dynamics.formulation.qp.functions()["qp"])
    return seconds_each(lambda: program.map("qp", q, v, n=len(q)), calls=20) / len(q)


def following(dynamics: rr.NeuralDynamics, instances: list[Instance]) -> float:
    """Largest distance from the optimum when each period makes one Euler step."""
    program = emit.compile(dynamics.step(rr.Euler(PERIOD)).functions()["step"])
    settled = SettledNetwork(dynamics, tolerance=1e-8)
    settled.setup(instances[0])
    settled.solve()
    state, worst = np.array(settled._state), 0.0
    for instance in instances:
        settled.update(instance)
        best = settled.solve().x
        values = [instance.parameters[p.name] for p in dynamics.parameters]
        state = program.call("step", state, *values)[0]
        worst = max(worst, float(np.abs(state[: best.size] - best).max()))
    return worst
