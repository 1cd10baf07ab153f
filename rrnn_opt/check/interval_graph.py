"""Values and slopes of a claim's graph over boxes, in any interval arithmetic.

An arithmetic is a module of functions: :mod:`rrnn_opt.check.intervals` (arrays
of boxes) or :mod:`rrnn_opt.check.interval_balls` (one box, ball arithmetic).
Slopes are found backwards along the graph (reverse differentiation), every
operation in intervals, so that they hold every generalised gradient.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from types import ModuleType
from typing import Any

from rrnn_opt.check.claim_document import ClaimGraph, Step
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
    if step.op in UNARY or step.op in BINARY:
        return getattr(on, step.op)(*operands)
    if step.op == "pow":
        return power(on, operands[0], exponent(graph, step))
    if step.op in _LOGIC:
        return _LOGIC[step.op](on, *operands)
    raise UndecidedError(f"operation '{step.op}' is not known to intervals")


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


def slopes(
    graph: ClaimGraph, on: ModuleType, known: Sequence[Value], last: int
) -> dict[Any, Value]:
    """Derivatives of one value by every input element it depends on.

    Args:
        graph: the claim.
        on: the arithmetic.
        known: from :func:`values`.
        last: number of the value, which is :func:`smooth`.
    """
    way = needed(graph, last)
    adjoint: dict[int, Value] = {last: on.constant(1.0)}
    found: dict[Any, Value] = {}
    for number in sorted(way, reverse=True):
        step, g = graph.steps[number], adjoint.pop(number, None)
        if g is None:
            continue
        if step.slot is not None:
            before = found.get(step.slot)
            found[step.slot] = g if before is None else on.add(before, g)
            continue
        for arg, part in _backwards(graph, on, step, known, g):
            before = adjoint.get(arg)
            adjoint[arg] = part if before is None else on.add(before, part)
    return found


def _backwards(
    graph: ClaimGraph, on: ModuleType, step: Step, known: Sequence[Value], g: Value
) -> list[tuple[int, Value]]:
    """What an operation passes on to its operands."""
    if step.const is not None:
        return []
    op, args = step.op, step.args
    a, v = known[args[0]], known[step.out]
    if op == "pow":
        n = exponent(graph, step)
        rate = on.mul(on.constant(float(n)), power(on, a, n - 1))
        return [(args[0], on.mul(g, rate))]
    if op in _ONE:
        return [(args[0], _ONE[op](on, g, a, v))]
    first, second = _TWO[op](on, g, a, known[args[1]], v)
    return [(args[0], first), (args[1], second)]


_ONE: dict[str, Callable[..., Value]] = {
    "neg": lambda on, g, a, v: on.neg(g),
    "twice": lambda on, g, a, v: on.twice(g),
    "sq": lambda on, g, a, v: on.mul(g, on.twice(a)),
    "fabs": lambda on, g, a, v: on.mul(g, on.sign(a)),
    "inv": lambda on, g, a, v: on.neg(on.mul(g, on.sq(v))),
    "sqrt": lambda on, g, a, v: on.div(g, on.twice(v)),
    "sin": lambda on, g, a, v: on.mul(g, on.cos(a)),
    "cos": lambda on, g, a, v: on.neg(on.mul(g, on.sin(a))),
}


def _of_div(on: ModuleType, g: Value, a: Value, b: Value, v: Value) -> Any:
    part = on.div(g, b)
    return part, on.neg(on.mul(part, v))


def _of_min(on: ModuleType, g: Value, a: Value, b: Value, v: Value) -> Any:
    first = on.le(a, b)
    return on.mul(g, first), on.mul(g, on.sub(on.constant(1.0), first))


def _of_max(on: ModuleType, g: Value, a: Value, b: Value, v: Value) -> Any:
    second, first = _of_min(on, g, a, b, v)
    return first, second


_TWO: dict[str, Callable[..., tuple[Value, Value]]] = {
    "add": lambda on, g, a, b, v: (g, g),
    "sub": lambda on, g, a, b, v: (g, on.neg(g)),
    "mul": lambda on, g, a, b, v: (on.mul(g, b), on.mul(g, a)),
    "div": _of_div,
    "fmin": _of_min,
    "fmax": _of_max,
}
