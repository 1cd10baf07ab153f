"""The compiled loop: plant, signals and network in one translation unit."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from dataclasses import dataclass
from importlib import resources
from typing import Any

import casadi as ca
import numpy as np

from rrnn_opt import emit
from rrnn_opt.dynamics import DiscreteDynamics, Euler, NeuralDynamics
from rrnn_opt.errors import RrnnError
from rrnn_opt.robot import Kinematics
from rrnn_opt.simulation.multiplier import integrated
from rrnn_opt.simulation.record import Inputs, Pace, Record
from rrnn_opt.simulation.signals import RAW, Signals, Surroundings
from rrnn_opt.simulation.task import Array
from rrnn_opt.symbolic.split import only, split
from rrnn_opt.symbolic.symbol import Symbol
from rrnn_opt.symbolic.tape import Tape

Law = NeuralDynamics | DiscreteDynamics

LEVELS = {"velocity": 0, "acceleration": 1, "increment": 2}

_GIVEN = ("settings", "rd", "rd_dot", "rd_ddot", "velocity_noise", "acceleration_noise")
_POINTERS = (*_GIVEN, "state", "memory", "q", "u", "v", "qd", "tip")


class _Run(ctypes.Structure):
    """``rrnn_loop_t`` of loop.c, member by member."""

    _fields_ = (
        ("rows", ctypes.c_int64),
        ("most", ctypes.c_int64),
        ("h", ctypes.c_double),
        ("tolerance", ctypes.c_double),
        *((name, ctypes.c_void_p) for name in _POINTERS),
        ("unsettled", ctypes.c_int64),
    )


@dataclass(frozen=True, eq=False)
class Machine:
    """A compiled loop.

    Attributes:
        dynamics: the network in it.
        kin: kinematics of the plant.
        frame: tracked frame; None for the tip.
        level: of the scheme.
        built: the shared object.
        parameters: from the arguments ``RAW`` to the network's parameters.
        begin: from the network's parameters to its state at the start.
        memory: from the posture to the memory at the start.
        tip: from the posture to the frame's position, m.
    """

    dynamics: Law
    kin: Kinematics
    frame: str | None
    level: str
    built: emit.Built
    parameters: ca.Function
    begin: ca.Function
    memory: ca.Function
    tip: ca.Function
    _entry: Callable[..., int]

    def first_parameters(self, pace: Pace, q0: Array, inputs: Inputs) -> list[Array]:
        """Parameters of the network in the first period."""
        settings = [pace.dt, pace.kappa]
        raw: list[Any] = [q0, np.zeros(q0.size), self.memory(q0)]
        raw += [inputs.rd[0], inputs.rd_dot[0], inputs.rd_ddot[0], settings]
        return [np.asarray(p, dtype=np.float64) for p in self.parameters.call(raw)]

    def run(self, pace: Pace, q0: Array, inputs: Inputs) -> Record:
        """Run the whole task in C.

        Args:
            pace: how the loop goes.
            q0: (nv,) start, at rest.
            inputs: reference and noise.
        """
        rows, nv = len(inputs.rd), self.kin.robot.nv
        data = {"settings": np.array([pace.dt, pace.kappa])}
        for name in _GIVEN[1:]:
            data[name] = np.ascontiguousarray(getattr(inputs, name), np.float64)
        start = self.begin.call(self.first_parameters(pace, q0, inputs))[0]
        data["state"] = np.array(start, dtype=np.float64).ravel()
        data["memory"] = np.append(np.array(self.memory(q0)).ravel(), 0.0)
        data |= {name: np.zeros((rows, nv)) for name in ("q", "u", "v", "qd")}
        data["tip"] = np.zeros((rows, 3))
        data["q"][0] = q0
        run = _Run(rows, pace.most, pace.h, pace.tolerance)
        for name in _POINTERS:
            setattr(run, name, data[name].ctypes.data)
        steps = int(self._entry(ctypes.byref(run)))
        return Record(
            q=data["q"],
            command=data["u"],
            velocity=data["v"],
            qd=data["qd"],
            tip=data["tip"],
            network_steps=steps,
            unsettled=run.unsettled,
        )


def machine(
    dynamics: Law,
    kin: Kinematics,
    frame: str | None,
    around: Surroundings,
    *,
    epsilon: float,
) -> Machine:
    """Compile the loop, or find it compiled.

    Args:
        dynamics: its first nv outputs must be the joint quantity.
        kin: of the robot.
        frame: tracked frame; None for the tip.
        around: obstacles and contacts.
        epsilon: time constant of an integrated multiplier, s.

    Raises:
        CompilerError: there is no C compiler.
        RrnnError: the network does not fit this loop.
    """
    nv = kin.robot.nv
    if dynamics.output.size1() < nv:
        raise RrnnError(f"{dynamics.name}: its output is no joint quantity ({nv}, 1)")
    dynamics = integrated(dynamics, kin, frame, epsilon)
    signals = Signals(kin, frame, around)
    values = signals.tell(dynamics.parameters, dynamics.rates)
    built = emit.build(_source(dynamics, signals, values), name="simulate")
    entry = emit.load(built)["rrnn_loop"]
    entry.restype, entry.argtypes = ctypes.c_int64, (ctypes.c_void_p,)
    inputs = [p.sx for p in dynamics.parameters]
    return Machine(
        dynamics=dynamics,
        kin=kin,
        frame=frame,
        level=_level(dynamics),
        built=built,
        parameters=ca.Function("told", [signals.raw[k] for k in RAW], values),
        begin=ca.Function("begin", inputs, [dynamics.start]),
        memory=signals.start(),
        tip=ca.Function("tip", [kin.q], [signals.tip]),
        _entry=entry,
    )


def _level(dynamics: Law) -> str:
    form = dynamics.formulation
    return "velocity" if form is None else form.level


def _source(dynamics: Law, signals: Signals, values: list[ca.SX]) -> str:
    """The C text: emitted senses, step and command, and the hand-written loop."""
    whole = Tape.of(_period(dynamics, signals, values))
    sense, rest = split(whole, late=(0, 1), early_results=(3, 4))
    sizes = {
        "NV": signals.raw["q"].numel(),
        "STATE": dynamics.state.size,
        "MEMORY": max(signals.raw["memory"].numel(), 1),
        "COEFFICIENTS": sense.outputs[-1].size,
        "LEVEL": LEVELS[_level(dynamics)],
    }
    loop = resources.files("rrnn_opt.simulation") / "runtime" / "loop.c"
    return "\n".join(
        [
            emit.prologue(),
            *(f"#define LOOP_{name} {value}" for name, value in sizes.items()),
            emit.c_function(sense, "loop_sense"),
            emit.c_function(only(rest, (0, 1)), "loop_step"),
            emit.c_function(only(rest, (2,)), "loop_output"),
            loop.read_text("utf-8"),
        ]
    )


def _period(dynamics: Law, signals: Signals, values: list[ca.SX]) -> ca.Function:
    """State, h and the loop's own quantities to all that a period computes."""
    h = Symbol.vector("euler_h", 1, "s", "Euler step")
    step = dynamics.step(Euler(h))
    nv = signals.raw["q"].numel()
    parts = [step.next, ca.norm_inf(dynamics.residual), dynamics.output[:nv]]
    symbols = [p.sx for p in dynamics.parameters]
    parts = ca.substitute(parts, symbols, values)
    following = signals.following if signals.following.numel() else ca.SX(0)
    names = ["next", "residual", "u", "tip", "following"]
    raw = [signals.raw[name] for name in RAW]
    return ca.Function(
        "period",
        [dynamics.state.sx, h.sx, *raw],
        [*parts, signals.tip, following],
        ["state", "h", *RAW],
        names,
    )
