"""Neural dynamics as data: an ODE or a map that comes to rest at the optimum."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, ClassVar, Self

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.symbolic.symbol import (
    Symbol,
    dense,
    require_declared,
    require_names,
    require_shape,
)

Part = Any
"""An SX column; None may be given for zeros, and becomes SX."""


@checked()
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


class Dynamics(ABC):
    """What an ODE and a map have in common: everything that a run reads.

    Attributes:
        name: a C identifier.
        state: x, (n, 1).  A network made from a formulation stacks the
            formulation's own symbols where it can, so its law and a function
            of the decision or the multipliers speak of the same variables.
        parameters: everything else that the law depends on.
        output: what the network tells the robot, any column.
        residual: zero exactly at equilibrium, (n, 1).
        multipliers: named dual variables as expressions: "lam" of the equality
            rows, "mu" of the inequality rows, "z_box" of the bounds.
        formulation: what it was made from, if anything.
        notes: what a user must know.
        start: where a run begins, (n, 1), of the parameters; zeros by default.
        rates: time derivatives that the network is told, by the name of what
            moves; each is one of the parameters.
    """

    name: str
    state: Symbol
    parameters: tuple[Symbol, ...]
    output: ca.SX
    residual: ca.SX
    multipliers: dict[str, ca.SX]
    formulation: Formulation | None
    notes: str
    start: Part
    rates: Mapping[str, Symbol]

    _law: ClassVar[str]

    def __post_init__(self) -> None:
        shape = (self.state.size, 1)
        require_shape(self.state.sx, shape, f"{self.name}: state")
        require_names(self._symbols, self.name)
        if self.start is None:
            object.__setattr__(self, "start", ca.SX.zeros(*shape))
        wanted = {self._law: shape, "residual": shape, "start": shape}
        wanted["output"] = (self.output.size1(), 1)
        for part, want in wanted.items():
            value = dense(getattr(self, part), want, f"{self.name}: {part}")
            object.__setattr__(self, part, value)
            symbols = self.parameters if part == "start" else self._symbols
            require_declared(value, symbols, f"{self.name}: {part}")

    @property
    def _symbols(self) -> tuple[Symbol, ...]:
        return (self.state, *self.parameters)

    @abstractmethod
    def step(self, method: Euler) -> DiscreteDynamics:
        """One step as a map; a symbolic step size is its last parameter."""

    def duals(self) -> dict[str, ca.SX]:
        """Multipliers of the rows as declared, as SX of state and parameters.

        Returns:
            "lam" (p, 1): multiplier of ``equalities == 0``, the lambda of (4),
            minus the ``y`` of qpsolvers; "mu" (m, 1): its ``z``; "z_box"
            (n, 1): at equilibrium its ``z_box``, negative at an active lower
            bound.  Keys without rows are absent.
        """
        return dict(self.multipliers)

    @cached_property
    def frozen(self) -> Self:
        """The same network over data that stand still: every rate is zero."""
        if not self.rates:
            return self
        moving = {s.name for s in self.rates.values()}
        parts = [self._law, "output", "residual", "start"]
        told = [getattr(self, part) for part in parts] + [*self.multipliers.values()]
        gone = [s.sx for s in self.rates.values()]
        still = ca.substitute(told, gone, [ca.SX.zeros(*s.shape) for s in gone])
        laws: dict[str, Any] = dict(zip(parts, still, strict=False))
        duals = still[len(parts) :]
        laws["multipliers"] = dict(zip(self.multipliers, duals, strict=True))
        kept = tuple(p for p in self.parameters if p.name not in moving)
        return replace(self, rates={}, parameters=kept, **laws)  # type: ignore[type-var]

    def _common(self) -> dict[str, ca.Function]:
        made = {
            name: self._function(name, {name: getattr(self, name)})
            for name in ("output", "residual")
        }
        if self.multipliers:
            made["duals"] = self._function("duals", self.multipliers)
        return made

    def _function(self, name: str, outputs: dict[str, ca.SX]) -> ca.Function:
        names = [s.name for s in self._symbols]
        inputs = [s.sx for s in self._symbols]
        return ca.Function(name, inputs, [*outputs.values()], names, [*outputs])


@checked(infinite=("longest_step",))
@dataclass(frozen=True, eq=False)
class NeuralDynamics(Dynamics):
    """``x' = f(x, parameters)``; see ``Dynamics`` for what is not listed here.

    Attributes:
        derivative: f, (n, 1), unit of x per second.
        longest_step: longest Euler step, s, that a run should choose when the
            modes at its start do not tell those that come later; else infinite.

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
    start: Part = None
    rates: Mapping[str, Symbol] = field(default_factory=dict)
    longest_step: float = float("inf")

    _law: ClassVar[str] = "derivative"

    def functions(self) -> dict[str, ca.Function]:
        """From state and parameters to "derivative", "output", "residual", "duals"."""
        law = {"derivative": self.derivative}
        return {"derivative": self._function("derivative", law)} | self._common()

    @checked()
    def step(self, method: Euler) -> DiscreteDynamics:
        """One step of an integrator, as a map."""
        extra = (method.h,) if isinstance(method.h, Symbol) else ()
        h = method.h.sx if isinstance(method.h, Symbol) else method.h
        return DiscreteDynamics(
            name=self.name,
            state=self.state,
            parameters=(*self.parameters, *extra),
            next=self.state.sx + h * self.derivative,
            output=self.output,
            residual=self.residual,
            multipliers=self.multipliers,
            formulation=self.formulation,
            notes=self.notes,
            start=self.start,
            rates=self.rates,
        )


@checked()
@dataclass(frozen=True, eq=False)
class DiscreteDynamics(Dynamics):
    """``x+ = g(x, parameters)``; see ``Dynamics`` for what is not listed here.

    An iteration, or one step of an integrator.

    Attributes:
        next: g, (n, 1).
        output: at x, before the step, any column.

    Raises:
        ShapeError: a part has the wrong shape.
        RrnnError: an undeclared symbol, or two of one name.
    """

    name: str
    state: Symbol
    parameters: tuple[Symbol, ...]
    next: ca.SX
    output: ca.SX
    residual: ca.SX
    multipliers: dict[str, ca.SX] = field(default_factory=dict)
    formulation: Formulation | None = None
    notes: str = ""
    start: Part = None
    rates: Mapping[str, Symbol] = field(default_factory=dict)

    _law: ClassVar[str] = "next"

    def functions(self) -> dict[str, ca.Function]:
        """``{"step": f}``: state and parameters in; "next", "output" out; and more.

        The others are "output", "residual" and "duals".
        """
        law = {"next": self.next, "output": self.output}
        return {"step": self._function("step", law)} | self._common()

    @checked()
    def step(self, method: Euler) -> DiscreteDynamics:
        """This map: one iteration has no step size.

        Args:
            method: nothing changes by it; a symbolic step size becomes the
                last parameter, so that a caller runs a map and an ODE alike.
        """
        if not isinstance(method.h, Symbol):
            return self
        return replace(self, parameters=(*self.parameters, method.h))
