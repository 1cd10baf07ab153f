"""A tape as a C kernel over intervals, many boxes at once.

The kernel rounds outwards (``support/interval*.h``) and takes boxes as columns:
one row of lower and one of upper ends for every input element.  It is compiled
for the host only; what runs on a robot is :mod:`rrnn_opt.emit.c99`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from rrnn_opt.emit.c99 import literal, require_identifier
from rrnn_opt.emit.prologue import support_text
from rrnn_opt.errors import UnsupportedOperationError
from rrnn_opt.symbolic.tape import Instruction, Tape

FLAGS = ("-std=gnu99", "-O1", "-frounding-math", "-fno-trapping-math", "-Wno-psabi")
"""For the compiler: vector types, no arithmetic behind the rounding mode's back, and
-O1, since long straight lines take a compiler ten times as long at -O2."""

UNARY = ("neg", "sq", "twice", "inv", "sqrt", "fabs", "sign", "not")
ARITHMETIC = ("add", "sub", "mul", "div", "fmin", "fmax")
BINARY = (*ARITHMETIC, "lt", "le", "eq", "ne", "and", "or", "if_else_zero")
MADE = frozenset(("add", "sub", "mul", "div", "sq", "twice", "inv", "sqrt"))
"""Operations that can make an unbounded interval of bounded ones."""
OPERATIONS = frozenset(
    ("input", "output", "const", "sin", "cos", "pow", *UNARY, *BINARY)
)
"""What intervals can do; anything else is refused, never guessed."""
HIGHEST_POWER = 16
_ACCUMULATORS = 4

_KERNEL = """\
{support}
static __attribute__((noinline)) void {name}_upwards(size_t n, const double *lo,
    const double *hi, double *rlo, double *rhi, double *width)
{{
    size_t k;
    for (k = 0; k < n; k += RRNN_LANES) {{
        rrnn_v w0 = RRNN_ALL(0.0), w1 = w0, w2 = w0, w3 = w0;
{body}
        w0 = (w0 + w1) + (w2 + w3);
        memcpy(width + k, &w0, sizeof w0);
    }}
}}

/* n boxes, a multiple of the lanes; row i of lo, hi, rlo and rhi is i n away.
 * Returns 0, or 1 when the rounding mode cannot be set. */
__attribute__((visibility("default"))) int {name}(size_t n, const double *lo,
    const double *hi, double *rlo, double *rhi, double *width)
{{
    const int mode = fegetround();
    if (fesetround(FE_UPWARD) != 0) {{
        return 1;
    }}
    {name}_upwards(n, lo, hi, rlo, rhi, width);
    return fesetround(mode) != 0;
}}
"""


def interval_source(tape: Tape, name: str) -> str:
    """C text of ``int NAME(n, lo, hi, rlo, rhi, width)``.

    Args:
        tape: what to evaluate; inputs and outputs are numbered element by
            element over all ports, matrices column by column.
        name: C name.

    Returns:
        A translation unit; compile it with :data:`FLAGS`.

    Raises:
        UnsupportedOperationError: intervals cannot do an operation of the tape.
        RrnnError: ``name`` is not a C identifier.
    """
    body = "\n".join(f"        {line}" for line in _body(tape))
    parts = [support_text(f"interval{part}.h") for part in ("", "_truth", "_sincos")]
    head = "\n".join(["#include <math.h>\n#include <stddef.h>", *parts])
    return _KERNEL.format(support=head, name=require_identifier(name), body=body)


def offsets(sizes: list[int]) -> list[int]:
    """Number of the first element of every port."""
    return [sum(sizes[:k]) for k in range(len(sizes))]


def _body(tape: Tape) -> Iterator[str]:
    first = offsets([port.size for port in tape.inputs])
    constants: dict[int, float] = {}
    pairs: set[int] = set()
    for count, step in enumerate(tape.instructions[: tape.n_values]):
        if step.op not in OPERATIONS:
            raise UnsupportedOperationError(step.op, "interval engine")
        if step.const is not None:
            if not math.isfinite(step.const):
                raise UnsupportedOperationError(f"{step.const}", "interval engine")
            constants[step.out] = step.const
        if step.op in ("sin", "cos"):
            arg = step.args[0]
            if arg not in pairs:
                pairs.add(arg)
                yield f"const rrnn_isc p{arg} = rrnn_i_sincos(t{arg});"
            yield f"const rrnn_i t{step.out} = p{arg}.{step.op[0]};"
            continue
        yield f"const rrnn_i t{step.out} = {_right(step, first, constants)};"
        if step.op in MADE or step.op == "pow":
            t = f"t{step.out}"
            yield f"w{count % _ACCUMULATORS} += {t}.n + {t}.h;"
    yield from _results(tape)


def _right(step: Instruction, first: list[int], constants: dict[int, float]) -> str:
    if step.const is not None:
        return f"rrnn_i_point({literal(step.const)})"
    if step.slot is not None:
        row = first[step.slot[0]] + step.slot[1]
        return f"rrnn_i_load(lo + {row} * n + k, hi + {row} * n + k)"
    if step.op == "pow":
        return _power(step, constants)
    operands = ", ".join(f"t{arg}" for arg in step.args)
    return f"rrnn_i_{step.op}({operands})"


def _power(step: Instruction, constants: dict[int, float]) -> str:
    """Whole constant exponents, by repeated squaring."""
    exponent = constants.get(step.args[1], 0.5)
    if exponent != int(exponent) or not 1 <= exponent <= HIGHEST_POWER:
        raise UnsupportedOperationError("pow", "interval engine")

    def text(n: int) -> str:
        if n == 1:
            return f"t{step.args[0]}"
        if n % 2:
            return f"rrnn_i_mul({text(n - 1)}, {text(1)})"
        return f"rrnn_i_sq({text(n // 2)})"

    return text(int(exponent))


def _results(tape: Tape) -> Iterator[str]:
    first = offsets([port.size for port in tape.outputs])
    values = {s.slot: s.args[0] for s in tape.instructions[tape.n_values :]}
    for j, port in enumerate(tape.outputs):
        for element in range(port.size):
            row = first[j] + element
            value = values.get((j, element))
            text = "rrnn_i_point(0.0)" if value is None else f"t{value}"
            yield f"rrnn_i_store(rlo + {row} * n + k, rhi + {row} * n + k, {text});"
