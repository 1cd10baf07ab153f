"""Degree walk: is an expression a polynomial of low degree in the decision?

CasADi's own ``quadratic_coeff`` is no gate: it takes ``fabs(u)``,
``fmin(u, 1)``, ``if_else(u > 0, ..)`` and ``floor(u)`` for quadratic with a
zero Hessian.  The walk reads the instruction tape instead.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from rrnn_opt.errors import NotAQpError
from rrnn_opt.symbolic.symbol import Symbol
from rrnn_opt.symbolic.tape import Instruction, Tape

_LINEAR = ("add", "sub", "neg", "twice")
_COMPARISONS = ("lt", "le", "eq", "ne", "and", "or", "not", "if_else_zero")
_INFIX = {"add": "+", "sub": "-", "mul": "*", "div": "/", "lt": "<", "le": "<="}
_INFIX |= {"eq": "==", "ne": "!=", "and": "&&", "or": "||"}
_PREFIX = {"neg": "-", "not": "!", "twice": "2*"}
_KINDS = {0: "free of", 1: "affine in", 2: "quadratic in"}


@dataclass(frozen=True)
class _Refusal:
    """Instruction that breaks the rule, and what to call it."""

    step: Instruction
    operation: str


def require_degree(
    expr: ca.SX,
    decision: Symbol,
    parameters: tuple[Symbol, ...],
    *,
    most: int,
    where: str,
) -> None:
    """Refuse an expression whose degree in the decision may exceed ``most``.

    The decision has degree 1, parameters and constants 0.  A sum has the
    larger degree of its terms, a product their sum, and a quotient that of its
    numerator when the denominator has degree 0.  No other operation may have
    an operand of positive degree.  The walk looks at no value, so terms that
    would cancel are refused too.

    Args:
        expr: SX of any shape.
        decision: the symbol that counts.
        parameters: all other free symbols.
        most: largest degree allowed, 0, 1 or 2.
        where: what the expression is; rows are numbered after it.

    Raises:
        NotAQpError: names the operation, the row and the subexpression.
    """
    symbols = (decision, *parameters)
    if _first_refusal(_tape(expr, symbols), most) is None:
        return
    for row in range(expr.numel()):
        tape = _tape(expr[row], symbols)
        refusal = _first_refusal(tape, most)
        if refusal is not None:
            place = where if expr.numel() == 1 else f"{where} row {row}"
            raise NotAQpError(
                place,
                refusal.operation,
                f"it must be {_KINDS[most]} '{decision.name}'",
                expression=_text(tape, refusal.step),
            )


def _tape(expr: ca.SX, symbols: tuple[Symbol, ...]) -> Tape:
    names = [s.name for s in symbols]
    inputs = [s.sx for s in symbols]
    return Tape.of(ca.Function("degree", inputs, [expr], names, ["value"]))


def _first_refusal(tape: Tape, most: int) -> _Refusal | None:
    degree: list[int] = []
    for step in tape.instructions:
        if step.op == "output":
            break
        operands = [degree[a] for a in step.args]
        result = _degree(step, operands)
        if result is None:
            return _Refusal(step, _operation(step.op))
        if result > most:
            return _Refusal(step, _excess(step.op, result))
        degree.append(result)
    return None


def _degree(step: Instruction, operands: list[int]) -> int | None:
    """Degree of a value, None when the operation is not a polynomial one."""
    if step.op == "input":
        return 1 if step.slot is not None and step.slot[0] == 0 else 0
    if max(operands, default=0) == 0:
        return 0
    if step.op in _LINEAR:
        return max(operands)
    if step.op == "mul":
        return operands[0] + operands[1]
    if step.op == "sq":
        return 2 * operands[0]
    if step.op == "div" and operands[1] == 0:
        return operands[0]
    return None


def _operation(op: str) -> str:
    return f"if_else (comparison {op})" if op in _COMPARISONS else op


def _excess(op: str, degree: int) -> str:
    if op in ("mul", "sq"):
        return f"{op} (product of degree {degree} in the decision)"
    return f"{op} of degree {degree}" if op != "input" else "the decision itself"


def _text(tape: Tape, step: Instruction, depth: int = 4) -> str:
    """A value written out, four operations deep."""
    if step.op == "const":
        return f"{step.const:g}"
    if step.op == "input" and step.slot is not None:
        port = tape.inputs[step.slot[0]]
        return port.name if port.size == 1 else f"{port.name}[{step.slot[1]}]"
    if depth == 0:
        return ".."
    parts = [_text(tape, tape.instructions[a], depth - 1) for a in step.args]
    if step.op in _INFIX:
        return f"({parts[0]} {_INFIX[step.op]} {parts[1]})"
    if step.op in _PREFIX:
        return f"{_PREFIX[step.op]}{parts[0]}"
    return f"{step.op}({', '.join(parts)})"
