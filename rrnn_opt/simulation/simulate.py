"""Closed-loop tracking with one scheme."""

from __future__ import annotations

import math
from dataclasses import replace

import casadi as ca
import numpy as np

from rrnn_opt.arguments import checked
from rrnn_opt.dynamics import DiscreteDynamics
from rrnn_opt.errors import ProblemError, RrnnError
from rrnn_opt.networks.step_size import settling_step
from rrnn_opt.robot import Robot
from rrnn_opt.simulation.machine import Machine
from rrnn_opt.simulation.prepare import Network, Scheme, prepared
from rrnn_opt.simulation.record import Inputs, Pace, Record
from rrnn_opt.simulation.reference import reference
from rrnn_opt.simulation.result import SimulationResult
from rrnn_opt.simulation.task import Array, Task

SETTLED = 1e-9
"""Network residual at which the reduced law counts as reached."""

MOST = 20_000
"""Network steps a control period that the reduced law may take."""

_FINE = 10
"""Under the literal law, network steps in the time of one settling step."""

_SHRINK = 0.25
_ATTEMPTS = 4


@checked()
def simulate(
    scheme: str | Scheme, robot: Robot, task: Task, *, network: Network | None = None
) -> SimulationResult:
    """Track the task's curve with one scheme, closed loop, in compiled C.

    A scheme of velocities meets a plant of first order, q' = u + noise; one of
    accelerations a plant of second order; one of increments makes its step in
    each period.  Under the "reduced" law the network settles in every control
    period (its state is carried over, so that few steps are needed); under the
    "literal" law it runs in time, its Euler steps filling the period: for
    ``position_feedback`` this is (17) as printed, of second order.  What the
    scheme is told is in ``signals``; rd_dot is the curve's, plus kappa times
    the measured error.

    Args:
        scheme: function of the kinematics that returns a formulation; it is
            given ``frame``, ``epsilon`` and ``contacts`` if it takes them.  Or
            the name of one in ``rrnn_opt.formulations``.
        robot: the robot.
        task: curve, start, control, noise and obstacles.
        network: rule that makes the dynamics; ``PrimalDual`` with the task's
            epsilon by default.

    Returns:
        Records and figures of the run.

    Raises:
        ProblemError: the task does not fit the robot or the scheme.
        CompilerError: there is no C compiler.
        RrnnError: the loop has no signal of some name, or the network diverges
            for every step tried.
    """
    _require_fit(task, robot)
    loop = prepared(scheme, robot, task, network)
    _require_told(task, loop)
    t: Array = task.control.dt * np.arange(task.steps + 1, dtype=np.float64)
    tip = np.asarray(loop.tip(task.q0), dtype=np.float64).ravel()
    values = reference(task.curve, tip, t)
    inputs = inputs_of(task, values, robot.nv, loop.level)
    pace = pace_of(loop, task, inputs)
    record, h = _run(loop, pace, task.q0, inputs)
    return SimulationResult(
        scheme=loop.dynamics.name,
        robot=robot,
        task=task,
        t=t,
        reference=values[0],
        record=record,
        step=h,
        level=loop.level,
    )


def pace_of(loop: Machine, task: Task, inputs: Inputs) -> Pace:
    """Step and number of steps of the network; see ``settling_step``."""
    control = task.control
    still = Pace(control.dt, control.kappa, 1.0, 1, -1.0)
    h = _step(loop, loop.first_parameters(still, task.q0, inputs))
    if control.law == "literal":
        most = control.steps or math.ceil(_FINE * control.dt / h * (1.0 - 1e-9))
        return replace(still, h=control.dt / most, most=most)
    return replace(still, h=h, most=control.steps or MOST, tolerance=SETTLED)


def _step(loop: Machine, parameters: list[Array]) -> float:
    """A step for the first period; a map has none."""
    dynamics = loop.dynamics
    if isinstance(dynamics, DiscreteDynamics):
        return 1.0
    start = np.array(loop.begin.call(parameters)[0], dtype=np.float64).ravel()
    return min(settling_step(dynamics, start, parameters), dynamics.longest_step)


def inputs_of(
    task: Task, values: tuple[Array, Array, Array], nv: int, level: str
) -> Inputs:
    """The reference, and the noise where it enters."""
    noise, dt = task.noise, task.control.dt
    rd, rd_dot, rd_ddot = values
    rng, rows = np.random.default_rng(noise.seed), len(rd)
    joint, force = np.zeros((rows, nv)), np.zeros((rows, nv))
    if noise.enters == "task_velocity":
        draws = noise.sigma * rng.standard_normal((rows, 3))
        rd_dot = rd_dot + draws
        rd_ddot = rd_ddot + np.diff(draws, axis=0, prepend=0.0) / dt
        return Inputs(rd, rd_dot, rd_ddot, joint, force)
    draws = noise.sigma * rng.standard_normal((rows, nv))
    if noise.enters == "joint_velocity":
        return Inputs(rd, rd_dot, rd_ddot, draws, force)
    if level == "acceleration":
        return Inputs(rd, rd_dot, rd_ddot, joint, draws)
    return Inputs(rd, rd_dot, rd_ddot, dt * np.cumsum(draws, axis=0), force)


def _run(loop: Machine, pace: Pace, q0: Array, inputs: Inputs) -> tuple[Record, float]:
    """Run; under the reduced law a step that is too long is shortened.

    It is when the run diverges, or when the network does not come to rest
    (contacts that act make it stiffer than it was at the start) and does so
    more often with a shorter step.
    """
    best: tuple[Record, float] | None = None
    for _ in range(_ATTEMPTS):
        record = loop.run(pace, q0, inputs)
        if np.isfinite(record.command).all() and np.isfinite(record.q).all():
            if best is not None and best[0].unsettled <= record.unsettled:
                return best
            best = record, pace.h
            if record.unsettled == 0:
                return best
        if pace.tolerance < 0.0:
            break
        pace = replace(pace, h=pace.h * _SHRINK)
    if best is not None:
        return best
    raise RrnnError(
        f"{loop.dynamics.name}: the run diverges with network steps of "
        f"{pace.h:g} s; take a smaller control.dt or more control.steps"
    )


def _require_fit(task: Task, robot: Robot) -> None:
    """The start has one number a joint and is within the limits."""
    if task.q0.shape != (robot.nv,):
        message = f"'{robot.name}' has {robot.nv} joints, got {task.q0.size} numbers"
        raise ProblemError("robot.q0", message)
    outside = (task.q0 < robot.limits.lower) | (task.q0 > robot.limits.upper)
    for k in np.flatnonzero(outside):
        low, high = robot.limits.lower[k], robot.limits.upper[k]
        message = f"{task.q0[k]:g} is outside the limits [{low:g}, {high:g}]"
        raise ProblemError(f"robot.q0[{k}]", message)
    robot.frame(task.frame)


def _require_told(task: Task, loop: Machine) -> None:
    """Noise and feedback that act on rd_dot need a scheme that is told it."""
    raw = loop.parameters.sx_in()
    seen = [
        ca.depends_on(ca.vertcat(*map(ca.vec, loop.parameters.call(raw))), raw[k])
        for k in (4, 5)
    ]
    name = loop.dynamics.name
    if not any(seen) and task.noise.enters == "task_velocity" and task.noise.sigma > 0:
        message = f"'{name}' is not told rd_dot; use joint_velocity"
        raise ProblemError("noise.enters", message)
    if not seen[0] and task.control.kappa > 0.0:
        message = f"'{name}' is not told rd_dot; leave kappa out"
        raise ProblemError("control.kappa", message)
