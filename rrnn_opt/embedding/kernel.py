"""The one function that a package is made of, and the fields of its structs."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from rrnn_opt.dynamics import Dynamics, Euler
from rrnn_opt.embedding.words import member
from rrnn_opt.emit.c99 import parameter_names
from rrnn_opt.symbolic import Symbol, Tape, shape_of

STEP = Symbol.scalar("step_size", "s", "Euler step of the network")


@dataclass(frozen=True)
class Field:
    """One array of a C struct.

    Attributes:
        name: C name.
        shape: (rows, columns); column-major in C.
        unit: SI unit.
        meaning: half a sentence.
    """

    name: str
    shape: tuple[int, int]
    unit: str
    meaning: str

    @property
    def size(self) -> int:
        """Number of elements."""
        return self.shape[0] * self.shape[1]


@dataclass(frozen=True, eq=False)
class Kernel:
    """One Euler step of a network, as a function and as named fields.

    Attributes:
        dynamics: the network.
        function: (state, parameters.., step_size) -> (next, output, residual)
            and, where the formulation has bounds, (lower, upper).
        tape: of the function.
        state: field of the state.
        inputs: fields of the parameters.
        output: field of the output.
        bounds: number of bounds, 0 without.
    """

    dynamics: Dynamics
    function: ca.Function
    tape: Tape
    state: Field
    inputs: tuple[Field, ...]
    output: Field
    bounds: int


def kernel(dynamics: Dynamics) -> Kernel:
    """One Euler step: the next state, the output there, and what the old state lacks.

    Args:
        dynamics: any network.

    Raises:
        RrnnError: a parameter is called "step_size".
        UnsupportedOperationError: the graph holds an unknown operation.
    """
    step = dynamics.step(Euler(STEP))
    outputs = {
        "next": step.next,
        "output": ca.substitute(step.output, step.state.sx, step.next),
        "residual": dynamics.residual,
    }
    bounds = 0
    form = dynamics.formulation
    if form is not None and form.qp.bounded:
        outputs |= {"lower": form.lower, "upper": form.upper}
        bounds = form.decision.size
    symbols = (step.state, *step.parameters)
    function = ca.Function(
        "kernel",
        [s.sx for s in symbols],
        [ca.densify(value) for value in outputs.values()],
        [s.name for s in symbols],
        list(outputs),
    )
    tape = Tape.of(function)
    names = [member(name) for name in parameter_names(tape)]
    fields = [
        Field(name, s.shape, s.unit, s.meaning)
        for name, s in zip(names, symbols, strict=False)
    ]
    output = _output_field(dynamics, shape_of(step.output))
    return Kernel(
        dynamics, function, tape, fields[0], tuple(fields[1:-1]), output, bounds
    )


def _output_field(dynamics: Dynamics, shape: tuple[int, int]) -> Field:
    form = dynamics.formulation
    if form is None or form.decision.shape != shape:
        return Field("output", shape, "1", "output of the network")
    return Field("output", shape, form.decision.unit, form.decision.meaning)
