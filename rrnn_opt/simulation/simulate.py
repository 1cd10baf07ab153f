"""Closed-loop tracking with one scheme."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import cast

import casadi as ca
import numpy as np

from rrnn_opt import formulations
from rrnn_opt.dynamics import NeuralDynamics
from rrnn_opt.errors import ProblemError, RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks import PrimalDual
from rrnn_opt.networks.step_size import settling_step
from rrnn_opt.robot import Kinematics, Robot
from rrnn_opt.simulation.machine import Machine, Pace, Record, machine
from rrnn_opt.simulation.reference import reference
from rrnn_opt.simulation.result import SimulationResult
from rrnn_opt.simulation.task import Array, Task

Scheme = Callable[..., Formulation]
Network = Callable[[Formulation], NeuralDynamics]

SETTLED = 1e-9
"""Network residual at which the reduced law counts as reached."""

MOST = 20_000
"""Network steps a control period that the reduced law may take."""

_FINE = 10
"""Under the literal law, network steps in the time of one settling step."""

_SHRINK = 0.25
_ATTEMPTS = 4


def simulate(
    scheme: str | Scheme, robot: Robot, task: Task, *, network: Network | None = None
) -> SimulationResult:
    """Track the task's curve with one scheme, closed loop, in compiled C.

    The plant is of first order: q+ = q + dt (u + noise).  Under the "reduced"
    law the network settles in every control period (its state is carried over,
    so that few steps are needed); under the "literal" law it runs in time, its
    Euler steps filling the period: for ``position_feedback`` this is (17) as
    printed, of second order.  rd_dot is the curve's, plus kappa times the
    measured error.

    Args:
        scheme: function of the kinematics that returns a formulation in the
            joint velocity with parameters among q, rd and rd_dot; it is given
            ``frame`` and ``epsilon`` if it takes them.  Or the name of one in
            ``rrnn_opt.formulations``.
        robot: the robot.
        task: curve, start, control and noise.
        network: rule that makes the dynamics; ``PrimalDual`` with the task's
            epsilon by default.

    Returns:
        Records and figures of the run.

    Raises:
        ProblemError: the task does not fit the robot or the scheme.
        CompilerError: there is no C compiler.
        RrnnError: the network diverges for every step tried.
    """
    _require_fit(task, robot)
    function = _named(scheme) if isinstance(scheme, str) else scheme
    loop = _machine(function, robot, task.frame, task.control.epsilon, network)
    _require_told(task, loop.dynamics)
    t: Array = task.control.dt * np.arange(task.steps + 1, dtype=np.float64)
    values = reference(task.curve, _tip(loop, task.q0), t)
    pace = _pace(loop, task, values)
    noise = _noise(task, t.size, robot.nv)
    record, h = _run(loop, pace, task.q0, values, noise)
    return SimulationResult(
        scheme=loop.dynamics.name,
        robot=robot,
        task=task,
        t=t,
        reference=values[0],
        record=record,
        step=h,
    )


def _named(name: str) -> Scheme:
    if name not in formulations.__all__:
        known = ", ".join(formulations.__all__)
        raise ProblemError("formulation", f"no scheme '{name}'; known: {known}")
    return cast(Scheme, getattr(formulations, name))


@lru_cache(maxsize=16)
def _machine(
    scheme: Scheme,
    robot: Robot,
    frame: str | None,
    epsilon: float,
    network: Network | None,
) -> Machine:
    """Declare, make the network and compile; remembered for the last few."""
    kin = Kinematics(robot)
    settings = {"frame": frame, "epsilon": epsilon}
    taken = inspect.signature(scheme).parameters
    form = scheme(kin, **{k: v for k, v in settings.items() if k in taken})
    rule = PrimalDual(epsilon=epsilon) if network is None else network
    return machine(rule(form), kin, frame)


def _tip(loop: Machine, q: Array) -> Array:
    position = ca.Function("tip", [loop.kin.q], [loop.kin.position(loop.frame)])
    return np.asarray(position(q), dtype=np.float64).ravel()


def _pace(loop: Machine, task: Task, values: tuple[Array, Array]) -> Pace:
    """Step and number of steps of the network; see ``settling_step``."""
    control, dynamics = task.control, loop.dynamics
    known = {"q": task.q0, "rd": values[0][0], "rd_dot": values[1][0]}
    parameters = [known[p.name] for p in dynamics.parameters]
    h = settling_step(dynamics, np.zeros(dynamics.state.size), parameters)
    if control.law == "literal":
        most = control.steps or math.ceil(_FINE * control.dt / h * (1.0 - 1e-9))
        return Pace(control.dt, control.kappa, control.dt / most, most, -1.0)
    return Pace(control.dt, control.kappa, h, control.steps or MOST, SETTLED)


def _noise(task: Task, rows: int, nv: int) -> tuple[Array, Array]:
    """Noise on the joint velocity (rows, nv) and on the told rd_dot (rows, 3)."""
    noise = task.noise
    rng = np.random.default_rng(noise.seed)
    joint, told = np.zeros((rows, nv)), np.zeros((rows, 3))
    if noise.enters == "task_velocity":
        return joint, noise.sigma * rng.standard_normal((rows, 3))
    draws = noise.sigma * rng.standard_normal((rows, nv))
    if noise.enters == "acceleration":
        draws = task.control.dt * np.cumsum(draws, axis=0)
    return draws, told


def _run(
    loop: Machine,
    pace: Pace,
    q0: Array,
    values: tuple[Array, Array],
    noise: tuple[Array, Array],
) -> tuple[Record, float]:
    """Run; under the reduced law a step that diverges is shortened."""
    for _ in range(_ATTEMPTS):
        record = loop.run(pace, q0, values, noise)
        if np.isfinite(record.command).all() and np.isfinite(record.q).all():
            return record, pace.h
        if pace.tolerance < 0.0:
            break
        pace = replace(pace, h=pace.h * _SHRINK)
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


def _require_told(task: Task, dynamics: NeuralDynamics) -> None:
    """Noise and feedback that act on rd_dot need a scheme that is told it."""
    if any(p.name == "rd_dot" for p in dynamics.parameters):
        return
    if task.noise.enters == "task_velocity" and task.noise.sigma > 0.0:
        message = f"'{dynamics.name}' is not told rd_dot; use joint_velocity"
        raise ProblemError("noise.enters", message)
    if task.control.kappa > 0.0:
        message = f"'{dynamics.name}' is not told rd_dot; leave kappa out"
        raise ProblemError("control.kappa", message)
