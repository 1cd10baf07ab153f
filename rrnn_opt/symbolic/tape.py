"""The instruction tape of a symbolic function, as plain data.

Every reader of an expression graph (C emitter, numpy, interval, SMT, rounding
error, degree walk) reads this list instead of talking to CasADi. Values are
numbered once and never overwritten (single assignment); common subexpressions
are merged and dead code is dropped, so equal graphs give equal tapes.
"""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterator
from dataclasses import dataclass

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.errors import RrnnError, UnsupportedOperationError
from rrnn_opt.symbolic.operations import BY_CODE, OPERATIONS, Operation

__all__ = ["OPERATIONS", "Instruction", "Operation", "Port", "Tape", "fingerprint"]


@dataclass(frozen=True, slots=True)
class Instruction:
    """One operation of a tape.

    Attributes:
        op: key of :data:`OPERATIONS`.
        out: number of the value it defines; -1 for "output".
        args: numbers of the values it reads.
        const: the constant, for "const".
        slot: (argument, element) for "input" and "output"; the element counts
            a dense matrix column by column.
    """

    op: str
    out: int
    args: tuple[int, ...] = ()
    const: float | None = None
    slot: tuple[int, int] | None = None


@dataclass(frozen=True, slots=True)
class Port:
    """Name and dense shape of one argument or result."""

    name: str
    shape: tuple[int, int]

    @property
    def size(self) -> int:
        """Number of elements."""
        return self.shape[0] * self.shape[1]


@dataclass(frozen=True, slots=True)
class Tape:
    """A function as data: ports and single-assignment instructions.

    The instruction that defines value ``k`` is ``instructions[k]``; the
    "output" instructions follow at the end. Elements of a result that no
    "output" names are structural zeros.

    Attributes:
        name: name of the function.
        inputs: its arguments.
        outputs: its results.
        instructions: values in order of evaluation, then outputs.
        n_values: number of values.
    """

    name: str
    inputs: tuple[Port, ...]
    outputs: tuple[Port, ...]
    instructions: tuple[Instruction, ...]
    n_values: int

    @staticmethod
    @checked()
    def of(fn: ca.Function) -> Tape:
        """Read a CasADi function once; an MX function is expanded first.

        Args:
            fn: function without free variables.

        Returns:
            Its tape, common subexpressions merged and dead code dropped.

        Raises:
            UnsupportedOperationError: the graph holds an operation outside
                :data:`OPERATIONS`, or cannot be expanded to scalars.
            RrnnError: the function has free variables.
        """
        scalar = _expanded(fn)
        inputs = tuple(Port(fn.name_in(i), fn.size_in(i)) for i in range(fn.n_in()))
        outputs = tuple(Port(fn.name_out(i), fn.size_out(i)) for i in range(fn.n_out()))
        values, results = _merged(scalar)
        instructions, count = _alive(values, results)
        return Tape(fn.name(), inputs, outputs, instructions, count)

    @property
    def operations(self) -> frozenset[str]:
        """Names of the operations that occur."""
        return frozenset(step.op for step in self.instructions)

    @property
    def fingerprint(self) -> str:
        """SHA-256 over ports and instructions; constants as exact hex floats."""
        digest = hashlib.sha256()
        for port in (*self.inputs, None, *self.outputs):
            digest.update(f"{port and (port.name, port.shape)}\n".encode())
        for step in self.instructions:
            const = None if step.const is None else step.const.hex()
            line = f"{step.op} {step.out} {step.args} {const} {step.slot}\n"
            digest.update(line.encode())
        return digest.hexdigest()


def fingerprint(fn: ca.Function) -> str:
    """SHA-256 of a function's tape: argument names, shapes and instructions.

    The name of the function itself does not enter; two graphs that differ in
    nothing but dead code or repeated subexpressions agree.

    Args:
        fn: SX or MX function.
    """
    return Tape.of(fn).fingerprint


def _expanded(fn: ca.Function) -> ca.Function:
    if fn.has_free():
        free = ", ".join(fn.get_free())
        raise RrnnError(
            f"function '{fn.name()}' has free variables ({free}); make them inputs"
        )
    if fn.is_a("SXFunction"):
        return fn
    try:
        return fn.expand()
    except RuntimeError as error:
        raise UnsupportedOperationError("MX call", "instruction tape") from error


def _raw(fn: ca.Function) -> Iterator[tuple[int, list[int], list[int], float | None]]:
    for k in range(fn.n_instructions()):
        code = fn.instruction_id(k)
        const = float(fn.instruction_constant(k)) if code == ca.OP_CONST else None
        yield code, fn.instruction_input(k), fn.instruction_output(k), const


def _dense(sparsity: ca.Sparsity) -> list[int]:
    """Dense column-major element of every structural nonzero."""
    rows = sparsity.size1()
    return [r + rows * c for r, c in zip(*sparsity.get_triplet(), strict=True)]


def _merged(fn: ca.Function) -> tuple[list[Instruction], list[Instruction]]:
    """Rename work registers to values; equal operations share one value."""
    slots_in = [_dense(fn.sparsity_in(i)) for i in range(fn.n_in())]
    slots_out = [_dense(fn.sparsity_out(i)) for i in range(fn.n_out())]
    values: list[Instruction] = []
    results: list[Instruction] = []
    known: dict[tuple[object, ...], int] = {}
    register: dict[int, int] = {}
    args: tuple[int, ...]
    for code, reads, writes, const in _raw(fn):
        name = _name(code)
        if name == "output":
            slot = (writes[0], slots_out[writes[0]][writes[1]])
            args = (register[reads[0]],)
            results.append(Instruction("output", -1, args, None, slot))
        elif name == "assign":
            register[writes[0]] = register[reads[0]]
        else:
            slot_in: tuple[int, int] | None = None
            args = ()
            if name == "input":
                slot_in = (reads[0], slots_in[reads[0]][reads[1]])
            else:
                args = tuple(register[r] for r in reads[: OPERATIONS[name].arity])
            step = Instruction(name, len(values), args, const, slot_in)
            register[writes[0]] = known.setdefault(_key(step), step.out)
            if register[writes[0]] == step.out:
                values.append(step)
    return values, results


def _name(code: int) -> str:
    if code in (ca.OP_ASSIGN, ca.OP_LIFT):
        return "assign"
    if code not in BY_CODE:
        raise UnsupportedOperationError(f"number {code}", "instruction tape")
    return BY_CODE[code].name


def _key(step: Instruction) -> tuple[object, ...]:
    swap = OPERATIONS[step.op].commutative
    args = tuple(sorted(step.args)) if swap else step.args
    const = step.const
    text = None if const is None else "nan" if math.isnan(const) else const.hex()
    return (step.op, args, text, step.slot)


def _alive(
    values: list[Instruction], results: list[Instruction]
) -> tuple[tuple[Instruction, ...], int]:
    """Drop what no result needs and number the rest without gaps."""
    needed = {arg for step in results for arg in step.args}
    for step in reversed(values):
        if step.out in needed:
            needed.update(step.args)
    number: dict[int, int] = {}
    alive: list[Instruction] = []
    for step in (*(v for v in values if v.out in needed), *results):
        args = tuple(number[a] for a in step.args)
        if step.op != "output":
            number[step.out] = len(number)
        out = number.get(step.out, -1)
        alive.append(Instruction(step.op, out, args, step.const, step.slot))
    return tuple(alive), len(number)
