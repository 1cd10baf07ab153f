"""Exact values of an expression graph at a rational point."""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

import casadi as ca

from rrnn_opt.errors import UndecidedError
from rrnn_opt.symbolic.tape import Tape


def exact_values(
    function: ca.Function, point: Mapping[str, Sequence[Fraction]]
) -> list[list[Fraction]]:
    """All results of a function, without rounding; angles must be 0.

    Args:
        function: with named inputs.
        point: numbers by input, column by column.

    Returns:
        One list a result, column by column.

    Raises:
        UndecidedError: a value is not rational, or an operation is unknown.
    """
    tape = Tape.of(function)
    values: list[Fraction] = []
    results = [[Fraction(0)] * (p.shape[0] * p.shape[1]) for p in tape.outputs]
    for step in tape.instructions:
        if step.op == "output" and step.slot is not None:
            results[step.slot[0]][step.slot[1]] = values[step.args[0]]
        elif step.op == "input" and step.slot is not None:
            values.append(Fraction(point[tape.inputs[step.slot[0]].name][step.slot[1]]))
        elif step.const is not None:
            values.append(Fraction(step.const))
        else:
            values.append(_applied(step.op, [values[a] for a in step.args]))
    return results


def _applied(op: str, args: list[Fraction]) -> Fraction:
    if op in ("sin", "cos") and args[0] == 0:
        return Fraction(int(op == "cos"))
    if op not in _RULES or (op == "div" and args[1] == 0):
        raise UndecidedError(f"'{op}' has no rational value here")
    return Fraction(_RULES[op](*args))


_RULES: dict[str, Callable[..., Any]] = {
    "add": operator.add,
    "sub": operator.sub,
    "mul": operator.mul,
    "div": operator.truediv,
    "neg": operator.neg,
    "sq": lambda a: a * a,
    "twice": lambda a: a + a,
    "fabs": abs,
    "fmin": min,
    "fmax": max,
    "lt": operator.lt,
    "le": operator.le,
    "eq": operator.eq,
    "ne": operator.ne,
    "not": lambda a: a == 0,
    "and": lambda a, b: a != 0 and b != 0,
    "or": lambda a, b: a != 0 or b != 0,
    "if_else_zero": lambda a, b: b if a != 0 else 0,
}
