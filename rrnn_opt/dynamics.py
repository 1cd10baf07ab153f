"""Neural dynamics as data: an ODE whose equilibrium is the programme's optimum."""

from __future__ import annotations

from dataclasses import dataclass, field

import casadi as ca

from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.symbolic.symbol import (
    Symbol,
    dense,
    require_declared,
    require_names,
    require_shape,
)


@dataclass(frozen=True)
class Euler:
    """Explicit Euler, ``x+ = x + h f(x)``.

    Attributes:
        h: step, s; a scalar Symbol makes it an argument of the step.

    Raises:
        RrnnError: h is not positive.
        ShapeError: the symbol is no scalar.
    """

    h: float | Symbol

    def __post_init__(self) -> None:
        if isinstance(self.h, Symbol):
            require_shape(self.h.sx, (1, 1), "Euler step")
        elif not 0.0 < self.h < float("inf"):
            raise RrnnError(f"Euler step {self.h}: it must be positive and finite")


@dataclass(frozen=True, eq=False)
class NeuralDynamics:
    """``x' = f(x, parameters)``.

    Attributes:
        name: a C identifier.
        state: x, (n, 1).  A network made from a formulation stacks the
            formulation's own symbols, so its derivative and a function of the
            decision or the multipliers speak of the same variables.
        parameters: everything else that f depends on.
        derivative: f, (n, 1), unit of x per second.
        output: what the network tells the robot, any column.
        residual: zero exactly at equilibrium, (n, 1).
        multipliers: named dual variables as expressions: "lam" of the equality
            rows, "mu" of the inequality rows, "z_box" of the bounds.
        formulation: what it was made from, if anything.
        notes: what a user must know.

    Raises:
        ShapeError: a part has the wrong shape.
        RrnnError: an undeclared symbol, or two of one name.
    """

    name: str
    state: Symbol
    parameters: tuple[Symbol, ...]
    derivative: ca.SX
    output: ca.SX
    residual: ca.SX
    multipliers: dict[str, ca.SX] = field(default_factory=dict)
    formulation: Formulation | None = None
    notes: str = ""

    def __post_init__(self) -> None:
        shape = (self.state.size, 1)
        require_shape(self.state.sx, shape, f"{self.name}: state")
        require_names(self._symbols, self.name)
        rows = self.output.size1()
        for part, want in (("derivative", shape), ("residual", shape)):
            value = dense(getattr(self, part), want, f"{self.name}: {part}")
            object.__setattr__(self, part, value)
        output = dense(self.output, (rows, 1), f"{self.name}: output")
        object.__setattr__(self, "output", output)
        for part in ("derivative", "residual", "output"):
            require_declared(getattr(self, part), self._symbols, f"{self.name}: {part}")

    @property
    def _symbols(self) -> tuple[Symbol, ...]:
        return (self.state, *self.parameters)

    def duals(self) -> dict[str, ca.SX]:
        """Multipliers of the rows as declared, as SX of state and parameters.

        Returns:
            "lam" (p, 1): multiplier of ``equalities == 0``, the lambda of (4),
            minus the ``y`` of qpsolvers; "mu" (m, 1): its ``z``; "z_box"
            (n, 1): at equilibrium its ``z_box``, negative at an active lower
            bound.  Keys without rows are absent.
        """
        return dict(self.multipliers)

    def functions(self) -> dict[str, ca.Function]:
        """From state and parameters to "derivative", "output", "residual", "duals"."""
        made = {
            name: self._function(name, {name: getattr(self, name)})
            for name in ("derivative", "output", "residual")
        }
        if self.multipliers:
            made["duals"] = self._function("duals", self.multipliers)
        return made

    def step(self, method: Euler) -> Step:
        """One step of an integrator, symbolic.

        Args:
            method: the integrator with its step size.

        Returns:
            The next state and a function for it.
        """
        extra = (method.h,) if isinstance(method.h, Symbol) else ()
        h = method.h.sx if isinstance(method.h, Symbol) else method.h
        following = self.state.sx + h * self.derivative
        return Step(self.state, (*self.parameters, *extra), following, self.output)

    def _function(self, name: str, outputs: dict[str, ca.SX]) -> ca.Function:
        return _function(name, self._symbols, outputs)


@dataclass(frozen=True, eq=False)
class Step:
    """A map from one state to the next.

    Attributes:
        state: x, (n, 1).
        parameters: everything else, the step size last when it is a symbol.
        next: x+, (n, 1).
        output: output at x, before the step.

    Raises:
        RrnnError: two symbols of one name.
    """

    state: Symbol
    parameters: tuple[Symbol, ...]
    next: ca.SX
    output: ca.SX

    def __post_init__(self) -> None:
        require_names((self.state, *self.parameters), "step")

    def functions(self) -> dict[str, ca.Function]:
        """``{"step": f}``: state and parameters in; "next", "output" out."""
        outputs = {"next": self.next, "output": self.output}
        return {"step": _function("step", (self.state, *self.parameters), outputs)}


def _function(
    name: str, symbols: tuple[Symbol, ...], outputs: dict[str, ca.SX]
) -> ca.Function:
    values = list(outputs.values())
    names = [s.name for s in symbols]
    return ca.Function(name, [s.sx for s in symbols], values, names, [*outputs])
