"""A tape as a C kernel whose lanes are calls: eight configurations at once.

The text of one function is written for three widths: AVX-512 (8 doubles), AVX2
(4) and whatever every processor of the family has (2).  The shared object holds
all three and asks the processor, when it runs, which of them it may use.  Lanes
compute what :mod:`rrnn_opt.emit.c99` computes, to the bit: no contraction, no
fast-math, sine and cosine of our own.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from rrnn_opt.emit.c99 import literal, require_identifier
from rrnn_opt.emit.operations import LIBRARY
from rrnn_opt.emit.prologue import support_text
from rrnn_opt.errors import UnsupportedOperationError
from rrnn_opt.symbolic.tape import Instruction, Tape

FLAGS = ("-O2", "-Wno-psabi")
PORTABLE = 2
"""Lanes of the width that needs no extension of the processor."""
WIDTHS = {8: "avx512f,avx512dq,fma", 4: "avx2,fma"}
"""Extensions that each wider one needs, x86-64 alone; widest first."""
BLOCK = max(WIDTHS)
"""Rows of a batch are padded to a multiple of this, so every width fits."""

LANE_TEXT: dict[str, str] = {
    "add": "{0} + {1}",
    "sub": "{0} - {1}",
    "mul": "{0} * {1}",
    "div": "{0} / {1}",
    "neg": "rrnn_neg({0})",
    "sq": "{0} * {0}",
    "twice": "{0} + {0}",
    "inv": "rrnn_all(1.0) / {0}",
}
LANE_TEXT |= {f: f"rrnn_{f}({{0}})" for f in ("sqrt", "fabs", "sign", "floor", "ceil")}
LANE_TEXT |= {f: f"rrnn_{f}({{0}}, {{1}})" for f in ("fmin", "fmax", "copysign")}
COMPARED: dict[str, str] = {"lt": "<", "le": "<=", "eq": "==", "ne": "!="}
JOINED: dict[str, str] = {"and": "&", "or": "|"}
TRUTHS = frozenset((*COMPARED, *JOINED, "not"))
"""Operations whose result is 0 or 1: held as masks, made numbers where one is due."""

_HEAD = """\
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#if defined(__x86_64__)
#define RRNN_X86
#include <immintrin.h>
#endif
"""
_VARIANT = """\
#define RRNN_LANES {lanes}
#define RRNN_TARGET {target}
{support}
static RRNN_TARGET void rrnn_kernel(size_t n, const double *const *in,
    const size_t *row, const size_t *step, double *const *out, size_t wide)
{{
    size_t k;
    (void)in;
    (void)row;
    (void)step;
    (void)out;
    for (k = 0; k < n; k += RRNN_LANES) {{
{body}
    }}
}}
#undef RRNN_LANES
#undef RRNN_TARGET
"""
_DISPATCH = """\
/* Lanes of the widest kernel that this processor can run. */
__attribute__((visibility("default"))) int {name}_lanes(void)
{{
#if defined(RRNN_X86)
    __builtin_cpu_init();
{asked}
#endif
    return {portable};
}}

/* n columns, a multiple of {block}.  Element e of column k of argument i is
 * in[i][e * row[i] + k * step[i]], of result i out[i][e * wide + k]. */
__attribute__((visibility("default"))) void {name}(int lanes, size_t n,
    const double *const *in, const size_t *row, const size_t *step,
    double *const *out, size_t wide)
{{
    switch (lanes) {{
#if defined(RRNN_X86)
{cases}
#endif
    default: rrnn{portable}_kernel(n, in, row, step, out, wide);
    }}
}}
"""


def lanes_source(tape: Tape, name: str) -> str:
    """C text of ``int NAME_lanes()`` and ``void NAME(lanes, n, in, ...)``.

    Args:
        tape: what to evaluate.
        name: C name.

    Returns:
        A translation unit; compile it with :data:`FLAGS`.

    Raises:
        UnsupportedOperationError: an operation without C text.
        RrnnError: ``name`` is not a C identifier.
    """
    require_identifier(name)
    body = "\n".join(f"        {line}" for line in _body(tape))
    wide = [
        _variant(body, k, f'__attribute__((target("{needs}")))')
        for k, needs in WIDTHS.items()
    ]
    ways = [*wide, "#endif", _variant(body, PORTABLE, ""), _dispatch(name)]
    return "\n".join([_HEAD, "#if defined(RRNN_X86)", *ways])


def _variant(body: str, lanes: int, target: str) -> str:
    text = _VARIANT.format(
        lanes=lanes, target=target, support=support_text("lanes.h"), body=body
    )
    return re.sub(r"\brrnn_(\w+)", rf"rrnn{lanes}_\1", text)


def _dispatch(name: str) -> str:
    asked, cases = [], []
    for lanes, needs in WIDTHS.items():
        has = " && ".join(f'__builtin_cpu_supports("{x}")' for x in needs.split(","))
        asked.append(f"    if ({has}) {{\n        return {lanes};\n    }}")
        call = f"rrnn{lanes}_kernel(n, in, row, step, out, wide)"
        cases.append(f"    case {lanes}: {call}; break;")
    return _DISPATCH.format(
        name=name,
        asked="\n".join(asked),
        cases="\n".join(cases),
        portable=PORTABLE,
        block=BLOCK,
    )


def _body(tape: Tape) -> Iterator[str]:
    """Loads where values are defined, stores as soon as a result is known."""
    sinks: dict[int, list[tuple[int, int]]] = {}
    written: set[tuple[int, int]] = set()
    for step in tape.instructions[tape.n_values :]:
        assert step.slot is not None
        sinks.setdefault(step.args[0], []).append(step.slot)
        written.add(step.slot)
    for k, port in enumerate(tape.outputs):
        for e in range(port.size):
            if (k, e) not in written:
                yield _store(k, e, "rrnn_all(0.0)")
    text = _Values(tape)
    for step in tape.instructions[: tape.n_values]:
        yield from text.define(step)
        for k, e in sinks.get(step.out, ()):
            yield _store(k, e, text.number(step.out))


def _store(port: int, element: int, value: str) -> str:
    return f"rrnn_store(out[{port}] + {element} * wide + k, {value});"


class _Values:
    """How each value is spelled, as lanes of numbers or as a mask."""

    def __init__(self, tape: Tape) -> None:
        self._masks = {s.out for s in tape.instructions if s.op in TRUTHS}
        self._pairs: set[int] = set()

    def number(self, value: int) -> str:
        """Lanes of a value."""
        return f"rrnn_truth(m{value})" if value in self._masks else f"t{value}"

    def mask(self, value: int) -> str:
        """Where a value is not zero."""
        return f"m{value}" if value in self._masks else f"(t{value} != rrnn_all(0.0))"

    def define(self, step: Instruction) -> Iterator[str]:
        """Lines that define the value of one instruction."""
        args = [self.number(a) for a in step.args]
        if step.op in ("sin", "cos"):
            yield from self._turn(step)
        elif step.op in TRUTHS:
            yield f"const rrnn_m m{step.out} = {self._truth(step, args)};"
        elif step.op in LIBRARY:
            each = ", ".join(f"a{step.out}[{k}][l]" for k in range(len(args)))
            yield f"rrnn_v t{step.out}, a{step.out}[] = {{{', '.join(args)}}};"
            yield "for (int l = 0; l < RRNN_LANES; l++) {"
            yield f"    t{step.out}[l] = {step.op}({each});"
            yield "}"
        else:
            yield f"const rrnn_v t{step.out} = {self._lanes(step, args)};"

    def _turn(self, step: Instruction) -> Iterator[str]:
        arg = step.args[0]
        if arg not in self._pairs:
            self._pairs.add(arg)
            yield f"const rrnn_sc p{arg} = rrnn_sincos({self.number(arg)});"
        yield f"const rrnn_v t{step.out} = p{arg}.{step.op[0]};"

    def _truth(self, step: Instruction, args: list[str]) -> str:
        if step.op in COMPARED:
            return f"{args[0]} {COMPARED[step.op]} {args[1]}"
        masks = [self.mask(a) for a in step.args]
        return (
            f" {JOINED[step.op]} ".join(masks) if step.op in JOINED else f"~{masks[0]}"
        )

    def _lanes(self, step: Instruction, args: list[str]) -> str:
        if step.const is not None:
            return f"rrnn_all({literal(step.const).replace('real_t', 'double')})"
        if step.slot is not None:
            i, e = step.slot
            return f"rrnn_load(in[{i}] + {e} * row[{i}] + k * step[{i}])"
        if step.op == "if_else_zero":
            return f"(rrnn_v)({self.mask(step.args[0])} & (rrnn_m){args[1]})"
        if step.op not in LANE_TEXT:
            raise UnsupportedOperationError(step.op, "lane emitter")
        return LANE_TEXT[step.op].format(*args)
