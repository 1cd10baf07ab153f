"""The instruction tape in numpy: what the emitted C computes, to the bit.

Operations marked ``exact`` in the table (sine and cosine included: the same
algorithm as ``emit/support/sincos_*.h``) agree with C bit for bit in both
widths; the others are left to numpy and agree within a few units in the last
place.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rrnn_opt.errors import ShapeError, UnsupportedOperationError
from rrnn_opt.symbolic.tape import Instruction, Tape

Array = np.ndarray[Any, np.dtype[Any]]
Real = type[np.float64] | type[np.float32]


def _select(condition: Any, yes: Any, no: Any) -> Any:
    return np.where(condition, yes, no)


def _truth(condition: Any, like: Any) -> Any:
    return np.asarray(condition).astype(np.asarray(like).dtype)


NUMPY: dict[str, Callable[..., Any]] = {
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "div": lambda a, b: a / b,
    "neg": lambda a: -a,
    "sq": lambda a: a * a,
    "twice": lambda a: a + a,
    "inv": lambda a: np.asarray(a).dtype.type(1) / a,
    "sqrt": np.sqrt,
    "sin": lambda a: sincos(a)[0],
    "cos": lambda a: sincos(a)[1],
    "fabs": np.fabs,
    "sign": lambda a: _select(a < 0, -np.ones_like(a), _select(a > 0, 1, a)),
    "floor": np.floor,
    "ceil": np.ceil,
    "copysign": np.copysign,
    "fmin": lambda a, b: _select(a < b, a, b),
    "fmax": lambda a, b: _select(a > b, a, b),
    "lt": lambda a, b: _truth(a < b, a),
    "le": lambda a, b: _truth(a <= b, a),
    "eq": lambda a, b: _truth(a == b, a),
    "ne": lambda a, b: _truth(a != b, a),
    "not": lambda a: _truth(a == 0, a),
    "and": lambda a, b: _truth((a != 0) & (b != 0), a),
    "or": lambda a, b: _truth((a != 0) | (b != 0), a),
    "if_else_zero": lambda a, b: _select(a != 0, b, np.zeros_like(b)),
    "exp": np.exp,
    "expm1": np.expm1,
    "log": np.log,
    "log1p": np.log1p,
    "pow": np.power,
    "tan": np.tan,
    "asin": np.arcsin,
    "acos": np.arccos,
    "atan": np.arctan,
    "atan2": np.arctan2,
    "sinh": np.sinh,
    "cosh": np.cosh,
    "tanh": np.tanh,
    "hypot": np.hypot,
}
"""The numpy function of every operation that computes something."""


def evaluate(
    tape: Tape, inputs: Sequence[Array], dtype: Real = np.float64
) -> tuple[Array, ...]:
    """Run a tape.

    Args:
        tape: the instructions.
        inputs: one array for each argument, shape (rows, columns, ...) or, for
            a column, (rows,); further axes are evaluated side by side.
        dtype: float64 or float32, used for every single operation.

    Returns:
        One array for each result, shape (rows, columns, ...).

    Raises:
        ShapeError: an input does not fit its argument.
        UnsupportedOperationError: numpy lacks an operation.
    """
    arguments = _arguments(tape, inputs, dtype)
    values: list[Any] = []
    with np.errstate(all="ignore"):
        for step in tape.instructions[: tape.n_values]:
            values.append(_value(step, arguments, values, dtype))
    batch = np.broadcast_shapes(*(a.shape[2:] for a in arguments))
    results = [np.zeros((*p.shape, *batch), dtype) for p in tape.outputs]
    for step in tape.instructions[tape.n_values :]:
        if step.slot is not None:
            k, element = step.slot
            column, row = divmod(element, tape.outputs[k].shape[0])
            results[k][row, column] = values[step.args[0]]
    return tuple(results)


def _arguments(tape: Tape, inputs: Sequence[Array], dtype: Real) -> list[Array]:
    if len(inputs) != len(tape.inputs):
        raise ShapeError(f"{tape.name}: inputs", (len(tape.inputs),), (len(inputs),))
    arguments = []
    for port, given in zip(tape.inputs, inputs, strict=True):
        array = np.asarray(given).astype(dtype)
        if array.ndim < 2:
            array = array.reshape(array.size, 1)
        if array.shape[:2] != port.shape:
            raise ShapeError(port.name, port.shape, np.shape(given))
        arguments.append(array)
    return arguments


def _value(
    step: Instruction, arguments: list[Array], values: list[Any], dtype: Real
) -> Any:
    if step.const is not None:
        return dtype(step.const)
    if step.slot is not None:
        argument = arguments[step.slot[0]]
        column, row = divmod(step.slot[1], argument.shape[0])
        return argument[row, column]
    if step.op not in NUMPY:
        raise UnsupportedOperationError(step.op, "numpy interpreter")
    return NUMPY[step.op](*(values[a] for a in step.args))


@dataclass(frozen=True, slots=True)
class _Trigonometry:
    """Constants of ``sincos_double.h`` or ``sincos_float.h``."""

    big: float
    limit: float
    inverse: float
    parts: tuple[float, float, float]
    sine: tuple[float, ...]
    cosine: tuple[float, ...]


_DOUBLE = _Trigonometry(
    big=6755399441055744.0,
    limit=1073741824.0,
    inverse=0.6366197723675814,
    parts=(1.5707963267341256, 6.077100506303966e-11, 2.0222662487959506e-21),
    sine=(
        -1.66666666666666324348e-01,
        8.33333333332248946124e-03,
        -1.98412698298579493134e-04,
        2.75573137070700676789e-06,
        -2.50507602534068634195e-08,
        1.58969099521155010221e-10,
    ),
    cosine=(
        4.16666666666666019037e-02,
        -1.38888888888741095749e-03,
        2.48015872894767294178e-05,
        -2.75573143513906633035e-07,
        2.08757232129817482790e-09,
        -1.13596475577881948265e-11,
    ),
)
_FLOAT = _Trigonometry(
    big=12582912.0,
    limit=32768.0,
    inverse=float.fromhex("0x1.45f306p-1"),
    parts=(
        float.fromhex("0x1.921ep+0"),
        float.fromhex("0x1.b544p-16"),
        float.fromhex("0x1.0b4612p-34"),
    ),
    sine=(-1.6666654611e-1, 8.3321608736e-3, -1.9515295891e-4),
    cosine=(4.166664568298827e-2, -1.388731625493765e-3, 2.443315711809948e-5),
)


def sincos(x: Any) -> tuple[Array, Array]:
    """Sine and cosine by the algorithm of the emitted C, in the width of ``x``.

    At most 2 ulp off for ``|x| <= 50``; NaN beyond 2^30 (float32: 2^15).
    """
    x = np.asarray(x)
    single = x.dtype == np.float32
    table, real = (_FLOAT, np.float32) if single else (_DOUBLE, np.float64)
    with np.errstate(invalid="ignore"):
        ok = (x >= -table.limit) & (x <= table.limit)
    y = np.where(ok, x, real(np.nan))
    kd = (y * real(table.inverse) + real(table.big)) - real(table.big)
    k = np.where(ok, kd, real(0)).astype(np.int32)
    t = y - kd * real(table.parts[0])
    w = kd * real(table.parts[1])
    r = t - w
    d = ((t - r) - w) - kd * real(table.parts[2])
    z = r * r
    sr = r + (r * (z * _horner(table.sine, z, real)) + d)
    tail = (z * z) * _horner(table.cosine, z, real) - r * d
    cr = real(1) - (real(0.5) * z - tail)
    s, c = np.where(k & 1, cr, sr), np.where(k & 1, sr, cr)
    return np.where(k & 2, -s, s), np.where((k + 1) & 2, -c, c)


def _horner(coefficients: tuple[float, ...], z: Array, real: Real) -> Any:
    total: Any = real(coefficients[-1])
    for coefficient in coefficients[-2::-1]:
        total = real(coefficient) + z * total
    return total
