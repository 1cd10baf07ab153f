"""Replaying a point through a graph, with numbers that cannot mislead.

Where a graph has rational operations only, the numbers are rationals and the
values exact.  Elsewhere every number is a ball (midpoint and radius, Arb) that
is certain to contain the true value; a comparison that a ball leaves open is
repeated with twice the precision.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import flint

from rrnn_opt.check.claims.document import ClaimGraph, Element, Step
from rrnn_opt.errors import UndecidedError

Number = Any  # flint.fmpq or flint.arb: python-flint has no usable stubs
Table = Mapping[str, Callable[..., Number]]
_Kind = tuple[Table, Callable[[Any], Number], str]

FIRST_PRECISION, LAST_PRECISION = 64, 4096
MAX_EXPONENT = 4096


class _OpenError(Exception):
    """A ball is too wide to tell."""


class _IrrationalError(Exception):
    """An operation whose result is not rational."""


@dataclass(frozen=True)
class Replay:
    """What a point gives.

    Attributes:
        signs: one of -1, 0, 1 for every element of every output; none for an
            output whose signs were not asked for.
        trust: "exact" (rationals) or "arb" (balls).
        values: decimal text of the same elements.
    """

    signs: tuple[tuple[int, ...], ...]
    trust: str
    values: tuple[tuple[str, ...], ...]


def replay(
    graph: ClaimGraph, point: Mapping[Element, Fraction], *, skip: int | None = None
) -> Replay:
    """Certain signs of the outputs at a rational point.

    Args:
        graph: claim as read.
        point: a number for every (variable, element).
        skip: an output that must be defined at the point, whatever its signs;
            then every other value of the graph must be defined there as well,
            even one that no output needs.

    Raises:
        UndecidedError: the graph is not defined there, holds an operation
            that is not known here, or a sign stays open at the last precision.
    """
    try:
        return _replayed(graph, point, _EXACT, skip)
    except _IrrationalError:
        precision = FIRST_PRECISION
    except ZeroDivisionError:
        raise UndecidedError("the graph divides by zero at this point") from None
    while precision <= LAST_PRECISION:
        try:
            with flint.ctx.workprec(precision):
                return _replayed(graph, point, _BALL, skip)
        except _OpenError:
            precision *= 2
    raise UndecidedError(
        f"a sign is open at {LAST_PRECISION} bits: the value is zero to that"
        " precision, or not defined"
    )


def _replayed(
    graph: ClaimGraph,
    point: Mapping[Element, Fraction],
    kind: _Kind,
    skip: int | None,
) -> Replay:
    table, number, trust = kind
    zero = number(0)
    results = [[zero] * port.size for port in graph.outputs]
    values: list[Number] = []
    for step in graph.steps:
        if step.op == "output" and step.slot is not None:
            results[step.slot[0]][step.slot[1]] = values[step.args[0]]
        elif step.op == "input" and step.slot is not None:
            x = point[step.slot]
            values.append(number(flint.fmpq(x.numerator, x.denominator)))
        elif step.op == "const" and step.const is not None:
            values.append(number(_constant(step.const)))
        else:
            values.append(_applied(step, values, table))
    if skip is not None and not all(_is_defined(value) for value in values):
        raise _OpenError
    return Replay(
        tuple(_signs(row, signed=k != skip) for k, row in enumerate(results)),
        trust,
        tuple(tuple(_text(value) for value in row) for row in results),
    )


def _constant(value: float) -> flint.fmpq:
    if not math.isfinite(value):
        raise UndecidedError(f"the constant {value} is not a real number")
    return flint.fmpq(*value.as_integer_ratio())


def _applied(step: Step, values: Sequence[Number], table: Table) -> Number:
    if step.op not in table:
        if table is _RATIONALS and step.op in _BALLS:
            raise _IrrationalError
        raise UndecidedError(f"operation '{step.op}' is not known to the replay")
    try:
        return table[step.op](*(values[a] for a in step.args))
    except TypeError as error:
        raise UndecidedError(f"operation '{step.op}' has bad operands") from error


def _signs(row: Sequence[Number], *, signed: bool) -> tuple[int, ...]:
    if signed:
        return tuple(_sign(value) for value in row)
    return ()


def _is_defined(value: Number) -> bool:
    return isinstance(value, flint.fmpq) or bool(value.is_finite())


def _sign(value: Number) -> int:
    """-1, 0 or 1; comparisons of balls are true only when certain."""
    if value > 0:
        return 1
    if value < 0:
        return -1
    if value == 0:
        return 0
    raise _OpenError


def _text(value: Number) -> str:
    if isinstance(value, flint.fmpq):
        return str(value)
    return str(value.str(17, more=True))


def _decided(true: bool, false: bool) -> Number:
    if not (true or false):
        raise _OpenError
    return 1 if true else 0


def _truth(a: Number) -> bool:
    return bool(_decided(bool(a != 0), bool(a == 0)))


def _copysign(a: Number, b: Number) -> Number:
    if _sign(b) == 0:
        raise UndecidedError("copysign of a zero, whose sign is not a real number's")
    return abs(a) if _sign(b) > 0 else -abs(a)


def _rational_power(a: flint.fmpq, n: flint.fmpq) -> flint.fmpq:
    if n.q != 1 or abs(n) > MAX_EXPONENT:
        raise _IrrationalError
    return a ** int(n)


def _floor(a: flint.fmpq) -> flint.fmpq:
    return flint.fmpq(a.p // a.q)


def _shared(number: Callable[[Any], Number]) -> dict[str, Callable[..., Number]]:
    """Operations that read the same for rationals and balls."""
    return {
        "add": operator.add,
        "sub": operator.sub,
        "mul": operator.mul,
        "div": operator.truediv,
        "neg": operator.neg,
        "sq": lambda a: a * a,
        "twice": lambda a: a + a,
        "inv": lambda a: number(1) / a,
        "fabs": abs,
        "sign": lambda a: number(_sign(a)),
        "copysign": _copysign,
        "lt": lambda a, b: number(_decided(a < b, a >= b)),
        "le": lambda a, b: number(_decided(a <= b, a > b)),
        "eq": lambda a, b: number(_decided(a == b, a != b)),
        "ne": lambda a, b: number(_decided(a != b, a == b)),
        "not": lambda a: number(not _truth(a)),
        "and": lambda a, b: number(_truth(a) and _truth(b)),
        "or": lambda a, b: number(_truth(a) or _truth(b)),
        "if_else_zero": lambda a, b: b if _truth(a) else number(0),
    }


_RATIONALS: Table = _shared(flint.fmpq) | {
    "fmin": min,
    "fmax": max,
    "floor": _floor,
    "ceil": lambda a: -_floor(-a),
    "pow": _rational_power,
}
_ARB = flint.arb
_BALLS: Table = _shared(_ARB) | {
    "fmin": _ARB.min,
    "fmax": _ARB.max,
    "floor": _ARB.floor,
    "ceil": _ARB.ceil,
    "pow": operator.pow,
    "sqrt": _ARB.sqrt,
    "sin": _ARB.sin,
    "cos": _ARB.cos,
    "tan": _ARB.tan,
    "asin": _ARB.asin,
    "acos": _ARB.acos,
    "atan": _ARB.atan,
    "atan2": _ARB.atan2,
    "exp": _ARB.exp,
    "expm1": _ARB.expm1,
    "log": _ARB.log,
    "log1p": _ARB.log1p,
    "sinh": _ARB.sinh,
    "cosh": _ARB.cosh,
    "tanh": _ARB.tanh,
    "hypot": lambda a, b: (a * a + b * b).sqrt(),
}
_EXACT: _Kind = (_RATIONALS, flint.fmpq, "exact")
_BALL: _Kind = (_BALLS, flint.arb, "arb")
