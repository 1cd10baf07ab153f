"""The one table of operations that an expression graph is made of."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca


@dataclass(frozen=True, slots=True)
class Operation:
    """One row of the instruction table.

    Attributes:
        name: lower-case name used in :class:`Instruction`.
        code: CasADi's operation number.
        arity: number of operands.
        exact: IEEE 754 fixes the result to the bit, or (sin, cos) our own
            algorithm does; false where the C library decides the last bits.
        commutative: operands may be swapped without changing the result.
    """

    name: str
    code: int
    arity: int
    exact: bool = True
    commutative: bool = False


_ROWS = (
    Operation("input", ca.OP_INPUT, 0),
    Operation("output", ca.OP_OUTPUT, 1),
    Operation("const", ca.OP_CONST, 0),
    Operation("add", ca.OP_ADD, 2, commutative=True),
    Operation("sub", ca.OP_SUB, 2),
    Operation("mul", ca.OP_MUL, 2, commutative=True),
    Operation("div", ca.OP_DIV, 2),
    Operation("neg", ca.OP_NEG, 1),
    Operation("sq", ca.OP_SQ, 1),
    Operation("twice", ca.OP_TWICE, 1),
    Operation("inv", ca.OP_INV, 1),
    Operation("sqrt", ca.OP_SQRT, 1),
    Operation("sin", ca.OP_SIN, 1),
    Operation("cos", ca.OP_COS, 1),
    Operation("fabs", ca.OP_FABS, 1),
    Operation("sign", ca.OP_SIGN, 1),
    Operation("floor", ca.OP_FLOOR, 1),
    Operation("ceil", ca.OP_CEIL, 1),
    Operation("copysign", ca.OP_COPYSIGN, 2),
    Operation("fmin", ca.OP_FMIN, 2),
    Operation("fmax", ca.OP_FMAX, 2),
    Operation("lt", ca.OP_LT, 2),
    Operation("le", ca.OP_LE, 2),
    Operation("eq", ca.OP_EQ, 2, commutative=True),
    Operation("ne", ca.OP_NE, 2, commutative=True),
    Operation("not", ca.OP_NOT, 1),
    Operation("and", ca.OP_AND, 2, commutative=True),
    Operation("or", ca.OP_OR, 2, commutative=True),
    Operation("if_else_zero", ca.OP_IF_ELSE_ZERO, 2),
    Operation("exp", ca.OP_EXP, 1, exact=False),
    Operation("expm1", ca.OP_EXPM1, 1, exact=False),
    Operation("log", ca.OP_LOG, 1, exact=False),
    Operation("log1p", ca.OP_LOG1P, 1, exact=False),
    Operation("pow", ca.OP_POW, 2, exact=False),
    Operation("tan", ca.OP_TAN, 1, exact=False),
    Operation("asin", ca.OP_ASIN, 1, exact=False),
    Operation("acos", ca.OP_ACOS, 1, exact=False),
    Operation("atan", ca.OP_ATAN, 1, exact=False),
    Operation("atan2", ca.OP_ATAN2, 2, exact=False),
    Operation("sinh", ca.OP_SINH, 1, exact=False),
    Operation("cosh", ca.OP_COSH, 1, exact=False),
    Operation("tanh", ca.OP_TANH, 1, exact=False),
    Operation("hypot", ca.OP_HYPOT, 2, exact=False),
)
OPERATIONS: dict[str, Operation] = {row.name: row for row in _ROWS}
"""The one table of operations; every reader covers it or says what it lacks."""

BY_CODE: dict[int, Operation] = {row.code: row for row in _ROWS} | {
    ca.OP_CONSTPOW: OPERATIONS["pow"]
}
"""The same rows by CasADi's operation number."""
