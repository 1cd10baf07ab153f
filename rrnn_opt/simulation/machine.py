"""The compiled loop: plant and network in one translation unit."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from dataclasses import dataclass
from importlib import resources

import casadi as ca
import numpy as np

from rrnn_opt import emit
from rrnn_opt.dynamics import Euler, NeuralDynamics
from rrnn_opt.errors import RrnnError
from rrnn_opt.robot import Kinematics
from rrnn_opt.simulation.task import Array
from rrnn_opt.symbolic.symbol import Symbol

_C_NAME = {"q": "q", "rd": "rd", "rd_dot": "rd_dot"}
"""Parameters that the loop knows, and what they are called in its C text."""

_GLUE = """\
#define LOOP_NV {nv}
#define LOOP_STATE {state}
static void loop_step(const double *state, const double *q, const double *rd,
                      const double *rd_dot, double h, double *next, double *residual)
{{
    (void)q; (void)rd; (void)rd_dot;
    loop_euler({arguments}, &h, next, residual);
}}
static void loop_output(const double *state, const double *q, const double *rd,
                        const double *rd_dot, double *u)
{{
    (void)q; (void)rd; (void)rd_dot;
    loop_command({arguments}, u);
}}
"""

_GIVEN = ("rd", "rd_dot", "task_noise", "joint_noise")
_POINTERS = (*_GIVEN, "state", "q", "u", "qd", "tip")


class _Run(ctypes.Structure):
    """``rrnn_loop_t`` of loop.c, member by member."""

    _fields_ = (
        ("rows", ctypes.c_int64),
        ("most", ctypes.c_int64),
        ("dt", ctypes.c_double),
        ("h", ctypes.c_double),
        ("kappa", ctypes.c_double),
        ("tolerance", ctypes.c_double),
        *((name, ctypes.c_void_p) for name in _POINTERS),
        ("unsettled", ctypes.c_int64),
    )


@dataclass(frozen=True)
class Pace:
    """How the loop goes.

    Attributes:
        dt: control period, s.
        kappa: gain of the position feedback added to rd_dot, 1/s.
        h: Euler step of the network, s.
        most: network steps a period, at most.
        tolerance: residual at which the network counts as settled; negative:
            it always makes ``most`` steps.
    """

    dt: float
    kappa: float
    h: float
    most: int
    tolerance: float


@dataclass(frozen=True, eq=False)
class Record:
    """What the loop wrote, one row a control period.

    Attributes:
        q: positions, (rows, nv), rad or m.
        command: output of the network, (rows, nv), rad/s or m/s.
        qd: velocity done, noise included, (rows, nv).
        tip: position of the frame, (rows, 3), m.
        network_steps: Euler steps of the network in all.
        unsettled: periods that ended above the tolerance, if there is one.
    """

    q: Array
    command: Array
    qd: Array
    tip: Array
    network_steps: int
    unsettled: int


@dataclass(frozen=True, eq=False)
class Machine:
    """A compiled loop.

    Attributes:
        dynamics: the network in it.
        kin: kinematics of the plant.
        frame: tracked frame; None for the tip.
        built: the shared object.
    """

    dynamics: NeuralDynamics
    kin: Kinematics
    frame: str | None
    built: emit.Built
    _entry: Callable[..., int]

    def run(
        self,
        pace: Pace,
        q0: Array,
        reference: tuple[Array, Array],
        noise: tuple[Array, Array],
    ) -> Record:
        """Run the whole task in C.

        Args:
            pace: how the loop goes.
            q0: (nv,) start.
            reference: rd and rd_dot, (rows, 3) each.
            noise: on the joint velocity (rows, nv), on the task velocity (rows, 3).
        """
        rows = len(reference[0])
        given = (*reference, noise[1], noise[0])
        data = {
            name: np.ascontiguousarray(array, np.float64)
            for name, array in zip(_GIVEN, given, strict=True)
        }
        data["state"] = np.zeros(self.dynamics.state.size)
        data |= {name: np.zeros((rows, self.kin.robot.nv)) for name in ("q", "u", "qd")}
        data["tip"] = np.zeros((rows, 3))
        data["q"][0] = q0
        run = _Run(rows, pace.most, pace.dt, pace.h, pace.kappa, pace.tolerance)
        for name in _POINTERS:
            setattr(run, name, data[name].ctypes.data)
        steps = self._entry(ctypes.byref(run))
        return Record(
            data["q"], data["u"], data["qd"], data["tip"], int(steps), run.unsettled
        )


def machine(dynamics: NeuralDynamics, kin: Kinematics, frame: str | None) -> Machine:
    """Compile the loop, or find it compiled.

    Args:
        dynamics: output must be a joint velocity; parameters among q, rd, rd_dot.
        kin: of the robot.
        frame: tracked frame; None for the tip.

    Raises:
        CompilerError: there is no C compiler.
        RrnnError: the network does not fit this loop.
    """
    _require_fit(dynamics, kin.robot.nv)
    built = emit.build(loop_source(dynamics, kin, frame), name="simulate")
    entry = emit.load(built)["rrnn_loop"]
    entry.restype, entry.argtypes = ctypes.c_int64, (ctypes.c_void_p,)
    return Machine(dynamics, kin, frame, built, entry)


def loop_source(dynamics: NeuralDynamics, kin: Kinematics, frame: str | None) -> str:
    """The C text: emitted step, command and tip, and the hand-written loop."""
    names = ["state", *(_C_NAME[p.name] for p in dynamics.parameters)]
    glue = _GLUE.format(
        nv=kin.robot.nv, state=dynamics.state.size, arguments=", ".join(names)
    )
    tip = ca.Function("tip", [kin.q], [kin.position(frame)], ["q"], ["tip"])
    loop = resources.files("rrnn_opt.simulation") / "runtime" / "loop.c"
    return "\n".join(
        [
            emit.prologue(),
            emit.c_function(tip, "loop_tip"),
            emit.c_function(_euler(dynamics), "loop_euler"),
            emit.c_function(dynamics.functions()["output"], "loop_command"),
            glue,
            loop.read_text("utf-8"),
        ]
    )


def _euler(dynamics: NeuralDynamics) -> ca.Function:
    """State, parameters, h -> next state, largest component of the residual."""
    step = dynamics.step(Euler(Symbol.vector("euler_h", 1, "s", "Euler step")))
    symbols = (step.state, *step.parameters)
    outputs = [step.next, ca.norm_inf(dynamics.residual)]
    names = [s.name for s in symbols]
    return ca.Function(
        "euler", [s.sx for s in symbols], outputs, names, ["next_state", "largest"]
    )


def _require_fit(dynamics: NeuralDynamics, nv: int) -> None:
    unknown = [p.name for p in dynamics.parameters if p.name not in _C_NAME]
    if unknown:
        raise RrnnError(
            f"{dynamics.name}: the loop gives {', '.join(_C_NAME)}, "
            f"not parameter '{unknown[0]}'"
        )
    form = dynamics.formulation
    velocity = form is None or form.level == "velocity"
    if not velocity or dynamics.output.shape != (nv, 1):
        raise RrnnError(f"{dynamics.name}: its output is no joint velocity ({nv}, 1)")
