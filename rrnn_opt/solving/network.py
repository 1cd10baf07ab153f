"""A network that can be run to rest: compiled where there is a compiler."""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from importlib import resources

import casadi as ca
import numpy as np

from rrnn_opt import emit
from rrnn_opt.dynamics import DiscreteDynamics, Dynamics, Euler
from rrnn_opt.errors import CompilerError
from rrnn_opt.solving.parts import Array
from rrnn_opt.symbolic.symbol import Symbol

ESCAPE = 1e12
"""A residual beyond this means that the steps diverge."""

NEWTON_STEPS = 25

_GLUE = """\
#define SETTLE_STATE {state}
#define SETTLE_PARAMETERS {parameters}
static void settle_step(const real_t *state, const real_t *parameters, real_t h,
                        real_t *next, real_t *residual)
{{
    (void)parameters;
    settle_euler({arguments});
}}
"""

Loop = Callable[[Array, Sequence[Array], float, float, int], tuple[int, float]]


@dataclass(frozen=True, eq=False)
class Run:
    """What one run of the loop did.

    Attributes:
        state: where it stopped, (n,).
        steps: Euler (or Newton) steps made.
        residual: largest component of the network's residual there.
    """

    state: Array
    steps: int
    residual: float


@dataclass(frozen=True, eq=False)
class RestableNetwork:
    """The Euler loop of one network (a map's own), its output and its multipliers.

    Attributes:
        dynamics: the network.
        compiled: what was built, or None: then CasADi's interpreter runs it,
            about a hundred times slower.
    """

    dynamics: Dynamics
    compiled: emit.Built | None
    _loop: Loop

    @staticmethod
    def of(dynamics: Dynamics) -> RestableNetwork:
        """Compile the loop; without a compiler take the interpreter."""
        try:
            built = emit.build(loop_source(dynamics), name="settle")
        except CompilerError:
            return RestableNetwork(dynamics, None, _interpreted(dynamics))
        return RestableNetwork(dynamics, built, _loaded(built))

    def run(
        self,
        state: Array,
        parameters: Sequence[Array],
        *,
        step: float,
        tolerance: float,
        max_steps: int,
    ) -> Run:
        """Euler steps until the residual is within the tolerance, or it fails.

        Args:
            state: (n,) start; not changed.
            parameters: one column-major array a parameter, in order.
            step: h, s.
            tolerance: on the largest component of the network's residual.
            max_steps: at most so many steps.
        """
        state = np.array(state, dtype=np.float64)
        done, residual = self._loop(state, parameters, step, tolerance, max_steps)
        return Run(state, done, residual)

    def newton(
        self, state: Array, parameters: Sequence[Array], *, tolerance: float
    ) -> Run:
        """Newton's method on the network's own residual, which is zero at rest.

        The residual is piecewise linear in the state, so from a state in the
        right piece one step ends it; where the pieces differ it may fail.

        Args:
            state: (n,) start; not changed.
            parameters: as for ``run``.
            tolerance: on the largest component of the residual.
        """
        state = np.array(state, dtype=np.float64)
        for done in range(NEWTON_STEPS + 1):
            value, slope = self._linearised.call([state, *parameters])
            residual = np.asarray(value, dtype=np.float64).ravel()
            largest = float(np.abs(residual).max())
            if largest <= tolerance or not largest <= ESCAPE or done == NEWTON_STEPS:
                break
            state -= np.linalg.lstsq(np.asarray(slope), residual, rcond=1e-12)[0]
        return Run(state, done, largest)

    @property
    def steppable(self) -> bool:
        """Whether another step size makes another run; not so for a map."""
        return not isinstance(self.dynamics, DiscreteDynamics)

    def start(self, parameters: Sequence[Array]) -> Array:
        """Where a run begins, (n,)."""
        begin = self._start.call([*parameters])[0]
        return np.asarray(begin, dtype=np.float64).ravel()

    def read(self, state: Array, parameters: Sequence[Array]) -> dict[str, Array]:
        """Output ("output") and multipliers by name at a state."""
        values = self._readout.call([state, *parameters])
        names = ["output", *self.dynamics.multipliers]
        flat = (np.asarray(v, dtype=np.float64).ravel() for v in values)
        return dict(zip(names, flat, strict=True))

    @cached_property
    def _linearised(self) -> ca.Function:
        dyn = self.dynamics
        slope = ca.densify(ca.jacobian(dyn.residual, dyn.state.sx))
        return ca.Function("linearised", _inputs(dyn), [dyn.residual, slope])

    @cached_property
    def _start(self) -> ca.Function:
        return ca.Function("start", _inputs(self.dynamics)[1:], [self.dynamics.start])

    @cached_property
    def _readout(self) -> ca.Function:
        dyn = self.dynamics
        parts = [dyn.output, *dyn.multipliers.values()]
        return ca.Function("readout", _inputs(dyn), parts)


@lru_cache(maxsize=32)
def restable(dynamics: Dynamics) -> RestableNetwork:
    """``RestableNetwork.of``, remembered for the networks last used."""
    return RestableNetwork.of(dynamics)


def loop_source(dynamics: Dynamics) -> str:
    """The C text: the emitted Euler step and the hand-written loop."""
    offsets = np.cumsum([0, *[p.size for p in dynamics.parameters]])
    packed = [f"parameters + {k}" for k in offsets[:-1]]
    glue = _GLUE.format(
        state=dynamics.state.size,
        parameters=offsets[-1],
        arguments=", ".join(["state", *packed, "&h", "next", "residual"]),
    )
    loop = resources.files("rrnn_opt.solving") / "runtime" / "settle.c"
    step = emit.c_function(_euler(dynamics), "settle_euler")
    return "\n".join([emit.prologue(), step, glue, loop.read_text("utf-8")])


def _euler(dynamics: Dynamics) -> ca.Function:
    """State, parameters, h -> next state, largest component of the residual."""
    h = Symbol.vector("euler_h", 1, "s", "Euler step")
    step = dynamics.step(Euler(h))
    symbols = [step.state, *step.parameters]
    residual = ca.norm_inf(dynamics.residual)
    return ca.Function(
        "euler",
        [s.sx for s in symbols],
        [step.next, residual],
        [s.name for s in symbols],
        ["next_state", "largest"],
    )


def _loaded(built: emit.Built) -> Loop:
    """The compiled loop as a Python function that writes into ``state``."""
    entry = emit.load(built)["rrnn_settle"]
    real, pointer = ctypes.c_double, ctypes.c_void_p
    entry.restype = ctypes.c_int64
    entry.argtypes = (pointer, pointer, real, real, real, ctypes.c_int64, pointer)

    def loop(
        state: Array,
        parameters: Sequence[Array],
        step: float,
        tolerance: float,
        most: int,
    ) -> tuple[int, float]:
        residual = np.empty(1)
        flat = [value.ravel(order="F") for value in parameters]
        packed = np.concatenate([*flat, np.zeros(0)])
        done = entry(
            packed.ctypes.data,
            state.ctypes.data,
            step,
            tolerance,
            ESCAPE,
            most,
            residual.ctypes.data,
        )
        return int(done), float(residual[0])

    return loop


def _interpreted(dynamics: Dynamics) -> Loop:
    """The same loop through CasADi's interpreter."""
    euler = _euler(dynamics)

    def loop(
        state: Array,
        parameters: Sequence[Array],
        step: float,
        tolerance: float,
        most: int,
    ) -> tuple[int, float]:
        values = [ca.DM(value) for value in parameters]
        done = 0
        while True:
            following, largest = euler(state, *values, step)
            residual = float(largest)
            if residual <= tolerance or not residual <= ESCAPE or done >= most:
                return done, residual
            state[:] = np.asarray(following).ravel()
            done += 1

    return loop


def _inputs(dynamics: Dynamics) -> list[ca.SX]:
    return [dynamics.state.sx, *(p.sx for p in dynamics.parameters)]
