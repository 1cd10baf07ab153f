"""Values and slopes of a claim's graph over boxes, in any interval arithmetic.

An arithmetic is a module of functions: :mod:`rrnn_opt.check.arithmetic.intervals`
(arrays of boxes) or :mod:`rrnn_opt.check.arithmetic.ball_intervals` (one box, balls).
Slopes are found along the graph (forward differentiation), every operation in
intervals, so that they hold every generalised gradient.  Backwards would be fewer
operations, and wider: factors of a product would be enclosed apart.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from types import ModuleType
from typing import Any

from rrnn_opt.check.claims.document import ClaimGraph, Step
from rrnn_opt.errors import UndecidedError

Value = Any

HIGHEST_POWER = 16
UNARY = ("neg", "twice", "sq", "fabs", "inv", "sqrt", "sin", "cos", "sign")
BINARY = ("add", "sub", "mul", "div", "fmin", "fmax", "lt", "le", "if_else_zero")
_JUMPS = frozenset(("sign", "lt", "le", "eq", "ne", "not", "and", "or", "if_else_zero"))


def values(graph: ClaimGraph, on: ModuleType, box: dict[Any, Value]) -> list[Value]:
    """Enclosures of every value of the graph.

    Args:
        graph: the claim.
        on: the arithmetic.
        box: an interval for every (variable, element).

    Raises:
        UndecidedError: an operation that intervals do not know.
    """
    known: list[Value] = []
    for step in graph.steps:
        if step.op != "output":
            known.append(_value(graph, on, step, known, box))
    return known


def _value(
    graph: ClaimGraph,
    on: ModuleType,
    step: Step,
    known: Sequence[Value],
    box: dict[Any, Value],
) -> Value:
    if step.slot is not None:
        return box[step.slot]
    if step.const is not None:
        return on.constant(step.const)
    operands = [known[k] for k in step.args]
    if step.op not in (*UNARY, *BINARY, *_LOGIC, "pow"):
        raise UndecidedError(f"operation '{step.op}' is not known to intervals")
    if len(operands) != (1 if step.op in (*UNARY, "not") else 2):
        raise UndecidedError(f"operation '{step.op}' has bad operands")
    if step.op in UNARY or step.op in BINARY:
        return getattr(on, step.op)(*operands)
    if step.op == "pow":
        return power(on, operands[0], exponent(graph, step))
    return _LOGIC[step.op](on, *operands)


def _and(on: ModuleType, a: Value, b: Value) -> Value:
    return on.mul(on.not_(on.not_(a)), on.not_(on.not_(b)))


def _equal(on: ModuleType, a: Value, b: Value) -> Value:
    return _and(on, on.le(a, b), on.le(b, a))


_LOGIC: dict[str, Callable[..., Value]] = {
    "not": lambda on, a: on.not_(a),
    "and": _and,
    "or": lambda on, a, b: on.not_(_and(on, on.not_(a), on.not_(b))),
    "eq": _equal,
    "ne": lambda on, a, b: on.not_(_equal(on, a, b)),
}


def exponent(graph: ClaimGraph, step: Step) -> int:
    """A whole constant exponent.

    Raises:
        UndecidedError: it is none.
    """
    const = graph.steps[step.args[1]].const
    if const is None or const != const // 1 or not 1 <= const <= HIGHEST_POWER:
        raise UndecidedError("a power that is not a small whole number")
    return int(const)


def power(on: ModuleType, a: Value, n: int) -> Value:
    """The n-th power, n >= 0, squares being squares."""
    if n == 0:
        return on.constant(1.0)
    if n == 1:
        return a
    return on.mul(power(on, a, n - 1), a) if n % 2 else on.sq(power(on, a, n // 2))


def result(graph: ClaimGraph, output: int, element: int) -> int | None:
    """Number of the value of one element of an output; None: it is 0."""
    for step in graph.steps:
        if step.op == "output" and step.slot == (output, element):
            return step.args[0]
    return None


def needed(graph: ClaimGraph, last: int) -> set[int]:
    """Numbers of the values that a value depends on, itself included."""
    found = {last}
    for number in range(last, -1, -1):
        if number in found:
            found.update(graph.steps[number].args)
    return found


def smooth(graph: ClaimGraph, last: int) -> bool:
    """Whether no operation on the way to a value can jump."""
    return all(graph.steps[k].op not in _JUMPS for k in needed(graph, last))


def tangents(
    graph: ClaimGraph, on: ModuleType, known: Sequence[Value], slot: Any
) -> list[Value | None]:
    """Derivatives of all values by one input element; None: it is 0.

    A value behind a jump gets one too, which means nothing: see :func:`smooth`.

    Args:
        graph: the claim.
        on: the arithmetic.
        known: from :func:`values`.
        slot: (variable, element).
    """
    found: list[Value | None] = []
    for step in graph.steps:
        if step.op == "output":
            continue
        total: Value | None = on.constant(1.0) if step.slot == slot else None
        for arg, part in zip(step.args, _PARTS.get(step.op, ()), strict=False):
            given = found[arg]
            if given is not None:
                term = part(on, given, graph, step, known)
                total = term if total is None else on.add(total, term)
        found.append(total)
    return found


Part = Callable[[ModuleType, Value, ClaimGraph, Step, Sequence[Value]], Value]


def _times(factor: Callable[..., Value]) -> Part:
    """A derivative times what the operand moves; factor(on, operands, value)."""

    def part(
        on: ModuleType, t: Value, graph: ClaimGraph, step: Step, known: Sequence[Value]
    ) -> Value:
        return on.mul(t, factor(on, [known[k] for k in step.args], known[step.out]))

    return part


def _same(on: ModuleType, t: Value, *_: Any) -> Value:
    return t


def _minus(on: ModuleType, t: Value, *_: Any) -> Value:
    return on.neg(t)


def _double(on: ModuleType, t: Value, *_: Any) -> Value:
    return on.twice(t)


def _of_pow(
    on: ModuleType, t: Value, graph: ClaimGraph, step: Step, known: Sequence[Value]
) -> Value:
    n = exponent(graph, step)
    slope = on.mul(on.constant(float(n)), power(on, known[step.args[0]], n - 1))
    return on.mul(t, slope)


_FIRST = _times(lambda on, x, v: on.le(x[0], x[1]))
_SECOND = _times(lambda on, x, v: on.sub(on.constant(1.0), on.le(x[0], x[1])))
_PARTS: dict[str, tuple[Part, ...]] = {
    "add": (_same, _same),
    "sub": (_same, _minus),
    "neg": (_minus,),
    "twice": (_double,),
    "mul": (_times(lambda on, x, v: x[1]), _times(lambda on, x, v: x[0])),
    "sq": (_times(lambda on, x, v: on.twice(x[0])),),
    "div": (
        _times(lambda on, x, v: on.inv(x[1])),
        _times(lambda on, x, v: on.neg(on.div(v, x[1]))),
    ),
    "inv": (_times(lambda on, x, v: on.neg(on.sq(v))),),
    "sqrt": (_times(lambda on, x, v: on.inv(on.twice(v))),),
    "sin": (_times(lambda on, x, v: on.cos(x[0])),),
    "cos": (_times(lambda on, x, v: on.neg(on.sin(x[0]))),),
    "fabs": (_times(lambda on, x, v: on.sign(x[0])),),
    "fmin": (_FIRST, _SECOND),
    "fmax": (_SECOND, _FIRST),
    "pow": (_of_pow,),
}
"""What each operand's derivative adds to the result's; none for a jump."""
