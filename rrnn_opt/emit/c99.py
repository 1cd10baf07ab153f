"""Clean C99 text of one symbolic function.

Constant single-assignment locals, typed literals, ternary minimum and maximum,
sine and cosine of one argument computed together, dense column-major arrays
with their sizes in the signature. No allocation, no globals, no branches that
depend on data. Results may share memory with arguments: everything is read
before anything is written.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

import casadi as ca
import numpy as np

from rrnn_opt.emit.operations import C_TEXT, LIBRARY
from rrnn_opt.emit.prologue import SUFFIX, Real, require_real
from rrnn_opt.errors import RrnnError, UnsupportedOperationError
from rrnn_opt.symbolic.tape import Instruction, Port, Tape

_WORDS = frozenset(
    re.findall(
        r"\w+",
        """auto break case char const continue default do double else enum extern float
        for goto if inline int long register restrict return short signed sizeof
        static struct switch typedef union unsigned void volatile while
        real_t rrnn_sincos rrnn_sincos_t rrnn_sincos_all rrnn_turn
        rrnn_angle sqrt fabs floor ceil copysign NAN INFINITY""",
    )
) | {name + f for name in LIBRARY for f in ("", "f")}


def c_function(
    fn: ca.Function | Tape,
    name: str,
    *,
    real: Real = "double",
    static: bool = True,
    compact: bool = False,
    inline: bool = False,
) -> str:
    """Emit ``void NAME(const real_t q[7], ..., real_t out[3])``.

    Args:
        fn: SX or MX function, or its tape; arguments and results keep their
            names (a clash with C or with another argument gets an underscore).
        name: C name; an exported one should carry its owner's prefix.
        real: type that ``real_t`` stands for; fixes literals and library calls.
        static: internal linkage; otherwise the function is exported and
            preceded by its prototype.
        compact: sines and cosines of arguments in one call, for small code.
        inline: put into its callers in any case, so that a loop over lanes
            around it becomes vector instructions; needs ``static``.

    Returns:
        C99 text that follows :func:`rrnn_opt.emit.prologue`. Matrices are dense
        and column-major, structural zeros are written too.

    Raises:
        UnsupportedOperationError: the graph holds an operation without C text.
        RrnnError: ``name`` is not a C identifier.
    """
    tape = fn if isinstance(fn, Tape) else Tape.of(fn)
    require_real(real)
    names = parameter_names(tape)
    head = _signature(tape, require_identifier(name), names)
    linkage = "static" if static else f"RRNN_EXPORT {head};\n"
    linkage = "RRNN_INLINE" if static and inline else linkage
    lines = [_comment(tape, name), f"{linkage} {head}".replace("\n ", "\n"), "{"]
    lines += [f"    {line}" for line in _body(tape, names, real, compact)]
    return "\n".join([*lines, "}", ""])


def require_identifier(name: str) -> str:
    """Return ``name`` if C accepts it as an identifier.

    Raises:
        RrnnError: C or the emitted text uses it otherwise.
    """
    if not re.fullmatch(r"[A-Za-z_]\w*", name, re.ASCII) or name in _WORDS:
        raise RrnnError(f"'{name}' is not a usable C identifier")
    return name


def parameter_names(tape: Tape) -> list[str]:
    """C names of all arguments, then all results; unique and legal."""
    taken: set[str] = set(_WORDS)
    names: list[str] = []
    for port in (*tape.inputs, *tape.outputs):
        name = re.sub(r"\W", "_", port.name, flags=re.ASCII)
        while name in taken or re.fullmatch(r"\d.*|[tp]\d+", name):
            name += "_" if not name[0].isdigit() else ""
            name = f"_{name}" if name[0].isdigit() else name
        taken.add(name)
        names.append(name)
    return names


def library_calls(tape: Tape) -> list[str]:
    """Functions of ``math.h`` whose last bits the C library decides."""
    return sorted(op for op in tape.operations if op in LIBRARY)


def literal(value: float, real: Real = "double") -> str:
    """C literal of exactly this number in this type."""
    with np.errstate(over="ignore"):
        number = float(np.float32(value)) if real == "float" else float(value)
    if math.isnan(number):
        return "(real_t)NAN"
    if math.isinf(number):
        return "(real_t)INFINITY" if number > 0 else "(-(real_t)INFINITY)"
    text = repr(number)
    if real == "float":
        text = np.format_float_scientific(np.float32(number), unique=True, trim="0")
        short = np.format_float_positional(np.float32(number), unique=True, trim="0")
        text = short if len(short) <= len(text) else text
    text += SUFFIX[real]
    return f"({text})" if text.startswith("-") else text


def _signature(tape: Tape, name: str, names: list[str]) -> str:
    count = len(tape.inputs)
    params = [
        f"{'const ' if k < count else ''}real_t {names[k]}[{max(port.size, 1)}]"
        for k, port in enumerate((*tape.inputs, *tape.outputs))
    ]
    return f"void {name}({', '.join(params) or 'void'})"


def _comment(tape: Tape, name: str) -> str:
    def describe(ports: tuple[Port, ...]) -> str:
        return ", ".join(f"{p.name} {p.shape[0]}x{p.shape[1]}" for p in ports)

    libm = ", ".join(library_calls(tape)) or "none"
    return (
        f"/* {name}: ({describe(tape.inputs)}) -> ({describe(tape.outputs)});"
        f" {tape.n_values} values; library functions: {libm} */"
    )


def _body(tape: Tape, names: list[str], real: Real, compact: bool) -> Iterator[str]:
    text = _Operands(tape, real)
    if compact:
        yield from text.turn(tape, names)
    used = {
        step.slot[0] for step in tape.instructions if step.op == "input" and step.slot
    }
    for k in range(len(tape.inputs)):
        if k not in used:
            yield f"(void){names[k]};"
    for step in tape.instructions[: tape.n_values]:
        yield from text.define(step, names)
    results = {s.slot: s.args[0] for s in tape.instructions[tape.n_values :]}
    zero = literal(0.0, real)
    for k, port in enumerate(tape.outputs):
        target = names[len(tape.inputs) + k]
        if not port.size:
            yield f"(void){target};"
        for element in range(port.size):
            value = results.get((k, element))
            right = zero if value is None else text.of[value]
            yield f"{target}[{element}] = {right};"


class _Operands:
    """How each value is spelled where it is used."""

    def __init__(self, tape: Tape, real: Real) -> None:
        self.of: dict[int, str] = {}
        self._real: Real = real
        self._pairs: dict[int, str] = {}
        self._turned: set[int] = set()
        self._words = {
            "zero": literal(0.0, real),
            "one": literal(1.0, real),
            "f": "f" if real == "float" else "",
        }

    def turn(self, tape: Tape, names: list[str]) -> Iterator[str]:
        """Lines that turn through all angles that are elements of arguments."""
        steps = tape.instructions
        turned = {s.args[0] for s in steps if s.op in ("sin", "cos")}
        slots = {a: slot for a in sorted(turned) if (slot := steps[a].slot)}
        if len(slots) < 2:
            return
        first, count = next(iter(slots.values())), len(slots)
        run = [(first[0], first[1] + k) for k in range(count)]
        if list(slots.values()) == run:
            name = names[first[0]]
            angles = f"&{name}[{first[1]}]" if first[1] else name
        else:
            listed = ", ".join(f"{names[k]}[{e}]" for k, e in slots.values())
            yield f"const real_t rrnn_angle[{count}] = {{{listed}}};"
            angles = "rrnn_angle"
        yield f"rrnn_sincos_t rrnn_turn[{count}];"
        yield f"rrnn_sincos_all({angles}, {count}U, rrnn_turn);"
        self._pairs = {a: f"rrnn_turn[{k}]" for k, a in enumerate(slots)}
        read = {a for s in steps if s.op not in ("sin", "cos") for a in s.args}
        self._turned = set(slots) - read

    def define(self, step: Instruction, names: list[str]) -> Iterator[str]:
        """Lines that define the value of one instruction."""
        if step.out in self._turned:
            return
        if step.const is not None:
            self.of[step.out] = literal(step.const, self._real)
            return
        if step.op in ("sin", "cos"):
            arg = step.args[0]
            if arg not in self._pairs:
                self._pairs[arg] = f"p{arg}"
                yield f"const rrnn_sincos_t p{arg} = rrnn_sincos({self.of[arg]});"
            self.of[step.out] = f"{self._pairs[arg]}.{step.op[0]}"
            return
        self.of[step.out] = f"t{step.out}"
        if step.slot is not None:
            right = f"{names[step.slot[0]]}[{step.slot[1]}]"
        elif step.op in C_TEXT:
            operands = (self.of[a] for a in step.args)
            right = C_TEXT[step.op].format(*operands, **self._words)
        else:
            raise UnsupportedOperationError(step.op, "C99 emitter")
        yield f"const real_t t{step.out} = {right};"
