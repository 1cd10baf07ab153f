"""Control steps a second: the PA10's position task, closed loop, on one core.

A control step is everything of one period: the given reference and noise read,
forward kinematics and Jacobian, one step of the network (17), command and the arm's
motion, all recorded.  The same loop with the same numbers in CasADi's interpreter
(one call of one function a step, from Python) and in numpy, operation by
operation on arrays.
"""

import time

import numpy as np

import rrnn_opt as rr
from benchmarks.record import Benchmark, Row
from rrnn_opt.simulation import Control, Curve, Noise, Task
from rrnn_opt.simulation.prepare import prepared
from rrnn_opt.simulation.reference import reference
from rrnn_opt.simulation.simulate import inputs_of, pace_of

DT, EPSILON = 0.005, 0.01
STEPS = 200_000
SLOW_STEPS = 4_000


def task(steps):
    return Task(
        curve=Curve("circle", 10.0, steps * DT, plane="yz", radius=0.15),
        q0=np.deg2rad([0.0, 30.0, 0.0, 60.0, 0.0, 45.0, 0.0]),
        control=Control(dt=DT, epsilon=EPSILON, law="literal", steps=1),
        noise=Noise(sigma=0.05),
    )


def compiled(robot, what, repeats=7):
    """Best time of a whole run, s; and its last posture."""
    loop = prepared("position_feedback", robot, what)
    t = DT * np.arange(what.steps + 1.0)
    start = np.asarray(loop.tip(what.q0)).ravel()
    inputs = inputs_of(what, reference(what.curve, start, t), robot.nv, loop.level)
    pace = pace_of(loop, what, inputs)
    times = []
    for _ in range(repeats):
        begin = time.perf_counter()
        record = loop.run(pace, what.q0, inputs)
        times.append(time.perf_counter() - begin)
    return min(times), record.q[-1], inputs


def interpreted(robot, what, inputs):
    """The same loop, one CasADi call a step."""
    kin = rr.Kinematics(robot)
    form = rr.formulations.position_feedback(kin, epsilon=EPSILON)
    network = rr.networks.PrimalDual(epsilon=EPSILON)(form)
    step = network.step(rr.Euler(DT)).functions()["step"]
    q, u = what.q0.copy(), np.zeros(robot.nv)
    begin = time.perf_counter()
    for k in range(what.steps):
        u = np.asarray(step(u, q, inputs.rd[k])[0]).ravel()
        q = q + DT * (u + inputs.velocity_noise[k])
    return time.perf_counter() - begin, q


def by_numpy(robot, what, inputs):
    """The same loop by hand, on numpy arrays."""
    limits, tree = robot.limits, robot.tree
    placements = [np.asarray(m) for m in tree.placements]
    tip = robot.frame()
    q, u = what.q0.copy(), np.zeros(robot.nv)
    begin = time.perf_counter()
    for k in range(what.steps):
        frame, origins, axes = np.eye(4), [], []
        for i in range(tree.nj):
            frame = frame @ placements[i]
            axis = frame[:3, :3] @ tree.axes[i]
            origins.append(frame[:3, 3])
            axes.append(axis)
            frame = frame @ turn(tree.axes[i], q[i])
        point = (frame @ tip.placement)[:3, 3]
        J = np.cross(np.array(axes), point - np.array(origins)).T
        low = np.maximum(-0.5 * (q - limits.lower), -limits.velocity)
        high = np.minimum(-0.5 * (q - limits.upper), limits.velocity)
        drive = np.clip(J.T @ (inputs.rd[k] - point) / EPSILON, low, high)
        u = u + DT / EPSILON * (drive - u)
        q = q + DT * (u + inputs.velocity_noise[k])
    return time.perf_counter() - begin, q


def turn(axis, angle):
    """Rotation about an axis as a homogeneous matrix (Rodrigues)."""
    x, y, z = axis
    K = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    out = np.eye(4)
    out[:3, :3] += np.sin(angle) * K + (1.0 - np.cos(angle)) * K @ K
    return out


def run(benchmark: Benchmark) -> None:
    robot = rr.Robot.builtin("pa10")
    seconds, _, _ = compiled(robot, task(STEPS))
    rate = STEPS / seconds
    short = task(SLOW_STEPS)
    _, q, inputs = compiled(robot, short, repeats=1)
    casadi_s, casadi_q = interpreted(robot, short, inputs)
    numpy_s, numpy_q = by_numpy(robot, short, inputs)
    np.testing.assert_allclose(casadi_q, q, atol=1e-9)
    np.testing.assert_allclose(numpy_q, q, atol=1e-9)
    rates = {"CasADi's interpreter": casadi_s, "numpy": numpy_s}
    benchmark.add(Row("control steps a second, compiled", rate, "1/s"))
    for name, taken in rates.items():
        slow = SLOW_STEPS / taken
        benchmark.add(Row(f"control steps a second, {name}", slow, "1/s", rate / slow))
