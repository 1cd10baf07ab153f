"""Lyapunov functions and their derivative along dynamics, symbolic."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.dynamics import DiscreteDynamics, Dynamics, NeuralDynamics
from rrnn_opt.errors import RrnnError
from rrnn_opt.symbolic.symbol import (
    Symbol,
    dense,
    require_declared,
    require_names,
)


@checked()
@dataclass(frozen=True, eq=False)
class LyapunovFunction:
    """``V(x, p)`` over a state and parameters.

    Write V in the symbols of the dynamics: ``dynamics.state.sx``, or the
    decision and multipliers that it stacks, and ``dynamics.parameters``.

    Attributes:
        value: V, (1, 1).
        state: x.
        parameters: p; what V holds fixed, or what moves at a given rate.

    Raises:
        ShapeError: V is not a scalar.
        RrnnError: V depends on an undeclared symbol, or a name stands twice.
    """

    value: ca.SX
    state: Symbol
    parameters: tuple[Symbol, ...] = ()

    def __post_init__(self) -> None:
        require_names((self.state, *self.parameters), "Lyapunov function")
        object.__setattr__(self, "value", dense(self.value, (1, 1), "V"))
        require_declared(self.value, (self.state, *self.parameters), "V")

    @checked()
    def derivative(
        self,
        dynamics: NeuralDynamics,
        *,
        parameter_rates: Mapping[str, ca.SX] | None = None,
    ) -> ca.SX:
        """``V' = dV/dx f(x, p) + dV/dp p'`` along the dynamics.

        Nothing is assumed about parameters silently: those without a rate
        stand still.  A moving Jacobian is, for instance, V in ``q`` with
        ``parameter_rates={"q": dynamics.output}``; for a frozen one give V the
        Jacobian, or leave the rate out.

        Args:
            dynamics: f, over the same state symbol.
            parameter_rates: p' by the parameter's name, of its shape; SX of
                the state and the parameters.

        Returns:
            V', (1, 1).

        Raises:
            RrnnError: the state is another symbol, or a parameter of one name
                another one; a rate belongs to no parameter of V, or depends on
                an undeclared symbol.
            ShapeError: a rate has the wrong shape.
        """
        self._require_state(dynamics)
        rates = dict(parameter_rates or {})
        value = _along(self.value, self.state, dynamics.derivative)
        every = {s.name: s for s in self.parameters}
        for symbol in dynamics.parameters:
            if not _same(every.setdefault(symbol.name, symbol), symbol):
                raise RrnnError(
                    f"V and the dynamics have two symbols '{symbol.name}'; write V "
                    "in those of dynamics.parameters"
                )
        for symbol in self.parameters:
            if symbol.name in rates:
                name = f"rate of '{symbol.name}'"
                rate = dense(rates.pop(symbol.name), symbol.shape, name)
                require_declared(rate, (self.state, *every.values()), name)
                value = value + _along(self.value, symbol, rate)
        if rates:
            raise RrnnError(f"V has no parameter {', '.join(map(repr, rates))}")
        return ca.densify(value)

    @checked()
    def change(self, dynamics: DiscreteDynamics) -> ca.SX:
        """``V(g(x, p), p) - V(x, p)``: what one step does to V, data standing still.

        Args:
            dynamics: g, over the same state symbol.

        Returns:
            The difference, (1, 1).

        Raises:
            RrnnError: the state is another symbol.
        """
        self._require_state(dynamics)
        after = ca.substitute(self.value, self.state.sx, dynamics.next)
        return ca.densify(after - self.value)

    def _require_state(self, dynamics: Dynamics) -> None:
        if not _same(self.state, dynamics.state):
            raise RrnnError(
                f"V is a function of '{self.state.name}' and the dynamics have the "
                f"state '{dynamics.state.name}'; write V in dynamics.state.sx"
            )


@checked()
def merit(dynamics: Dynamics) -> LyapunovFunction:
    """``V = 1/2 |residual|^2``: zero exactly at the equilibria.

    For a network in (u, lambda, mu) the residual is ``P_Z(z - F(z)) - z``.
    That V falls along some network is a statement of its own, about that
    network; as a measure of what is missing it serves for all.

    Args:
        dynamics: any network.
    """
    value = ca.sumsqr(dynamics.residual) / 2
    return LyapunovFunction(value, dynamics.state, dynamics.parameters)


def _along(value: ca.SX, symbol: Symbol, rate: ca.SX) -> ca.SX:
    """Directional derivative of a scalar."""
    gradient = ca.gradient(value, symbol.sx)
    return ca.dot(ca.vec(gradient), ca.vec(rate))


def _same(first: Symbol, second: Symbol) -> bool:
    """Whether two symbols stand for the same elements in the same order."""
    return first.shape == second.shape and all(
        a.element_hash() == b.element_hash()
        for a, b in zip(_elements(first), _elements(second), strict=True)
    )


def _elements(symbol: Symbol) -> list[ca.SX]:
    return ca.vertsplit(ca.vec(symbol.sx))  # type: ignore[no-any-return]
