"""How far emitted code can be off by rounding, bounded over a box of inputs.

The tape is walked once.  Each value k carries an interval X_k of its exact
values (outward-rounded doubles) and a bound e_k of |computed - exact|, for
operations that round correctly to a unit roundoff u (IEEE 754; 2^-24 for float,
2^-53 for double): with p the error that the operands pass on,

    a + b:  p = e_a + e_b                      a b:  p = e_a |b| + e_b |a| + e_a e_b
    a / b:  p = (e_a + |a / b| e_b) / (|b| - e_b)
    sqrt a: p = min(sqrt e_a, e_a / sqrt a)    sin, cos: p = e_a

    e = p + u (|X| + p) + underflow

(N. J. Higham, "Accuracy and Stability of Numerical Algorithms", 2nd ed., SIAM
2002, chapter 3).  A contracted multiply-add rounds once less, which the bound
covers.  The emitted sine and cosine are within 2 units in the last place for
|x| <= 50 (``emit/support``); beyond that there is no bound here.  A comparison
whose outcome rounding may change is off by its whole jump.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from rrnn_opt.check.arithmetic import intervals
from rrnn_opt.emit.prologue import Real, require_real
from rrnn_opt.errors import RrnnError, ShapeError, UnsupportedOperationError
from rrnn_opt.symbolic.tape import Instruction, Tape

Array = NDArray[np.float64]
Box = Mapping[str, tuple[Any, Any]]

UNIT = {"float": 2.0**-24, "double": 2.0**-53}
UNDERFLOW = {"float": 2.0**-149, "double": 2.0**-1074}
LARGEST = {"float": 3.4e38, "double": 1.7e308}
SINCOS_UNITS, FARTHEST = 2.0, 50.0
_GROW = 1.0 + 2.0**-40


@dataclass(frozen=True, eq=False)
class _Value:
    """Interval of exact values, (2, B), and error bound, (B,)."""

    x: Array
    e: Array

    @property
    def most(self) -> Array:
        """Largest absolute exact value."""
        most: Array = np.maximum(np.abs(self.x[0]), np.abs(self.x[1]))
        return most

    @property
    def least(self) -> Array:
        """Least absolute exact value."""
        return intervals.least(self.x)


def rounding_bound(
    function: ca.Function | Tape, box: Box, real: Real = "float", *, splits: int = 6
) -> tuple[Array, ...]:
    """Bound |computed - exact| of every result over a box of inputs.

    The inputs are taken as they enter: numbers of the type ``real``, without
    an error of their own.

    Args:
        function: what is emitted, or its tape.
        box: (lower, upper) by the name of each argument; each of the
            argument's shape, or one number for all its elements.
        real: type of the emitted code.
        splits: the box is halved this often along its widest sides; more give
            a smaller bound, at twice the work each.

    Returns:
        One array for each result, of its shape; infinite where there is no
        bound (a division by what may be 0, an angle beyond 50 rad).

    Raises:
        RrnnError: an argument has no finite bounds, or they are crossed.
        ShapeError: bounds do not fit their argument.
        UnsupportedOperationError: the graph holds an operation whose rounding
            is not known, such as those of the C library.
    """
    require_real(real)
    tape = function if isinstance(function, Tape) else Tape.of(function)
    lower, upper = _halved(*_box(tape, box), splits)
    values: list[_Value] = []
    first = np.cumsum([0, *(port.size for port in tape.inputs)])
    with np.errstate(all="ignore"):
        for step in tape.instructions[: tape.n_values]:
            if step.slot is not None:
                row = int(first[step.slot[0]]) + step.slot[1]
                x = intervals.interval(lower[row], upper[row])
                values.append(_Value(x, np.zeros(lower.shape[1])))
            else:
                values.append(_walked(step, [values[a] for a in step.args], real))
    return _results(tape, values)


def _results(tape: Tape, values: Sequence[_Value]) -> tuple[Array, ...]:
    results = [np.zeros(port.shape) for port in tape.outputs]
    for step in tape.instructions[tape.n_values :]:
        if step.slot is not None:
            column, row = divmod(step.slot[1], tape.outputs[step.slot[0]].shape[0])
            worst = float(np.max(values[step.args[0]].e))
            results[step.slot[0]][row, column] = worst
    return tuple(results)


def _box(tape: Tape, box: Box) -> tuple[Array, Array]:
    """Both ends of all input elements in one column."""
    ends: list[list[Array]] = [[], []]
    for port in tape.inputs:
        if port.name not in box:
            raise RrnnError(f"rounding: no bounds for '{port.name}'")
        for side, given in zip(ends, box[port.name], strict=True):
            array = np.asarray(given, dtype=np.float64)
            if array.size not in (1, port.size):
                raise ShapeError(port.name, port.shape, array.shape)
            side.append(np.broadcast_to(array.ravel("F"), (port.size,)))
    lower, upper = (np.concatenate([np.zeros(0), *side]) for side in ends)
    if not (np.all(np.isfinite([lower, upper])) and np.all(lower <= upper)):
        raise RrnnError("rounding: bounds must be finite, the lower ones below")
    return lower, upper


def _halved(lower: Array, upper: Array, splits: int) -> tuple[Array, Array]:
    low, high = lower[:, None].copy(), upper[:, None].copy()
    for _ in range(splits if len(lower) else 0):
        k = int(np.argmax(high[:, 0] - low[:, 0]))
        cut = 0.5 * (low[k] + high[k])
        left, right = high.copy(), low.copy()
        left[k], right[k] = cut, cut
        low, high = np.hstack([low, right]), np.hstack([left, high])
    return low, high


def _walked(step: Instruction, args: list[_Value], real: Real) -> _Value:
    if step.const is not None:
        near = float(np.float32(step.const)) if real == "float" else step.const
        off = np.array([abs(near - step.const) * _GROW])
        return _Value(intervals.constant(step.const), off)
    if step.op in _EXACT:
        x, e = _EXACT[step.op](*args)
        return _Value(x, e)
    if step.op not in _ROUNDED:
        raise UnsupportedOperationError(step.op, "rounding bound")
    x, passed = _ROUNDED[step.op](*args)
    unit = UNIT[real] * (2 * SINCOS_UNITS if step.op in ("sin", "cos") else 1.0)
    most = np.maximum(np.abs(x[0]), np.abs(x[1])) + passed
    if step.op in ("sin", "cos"):  # a unit in the last place of a number up to 1
        most = np.where(args[0].most + args[0].e <= FARTHEST, 1.0, np.inf)
    e = (passed + unit * most + UNDERFLOW[real]) * _GROW
    return _Value(x, np.where(most + e < LARGEST[real], e, np.inf))


def _mul(a: _Value, b: _Value) -> tuple[Array, Array]:
    return intervals.mul(a.x, b.x), a.e * b.most + b.e * a.most + a.e * b.e


def _div(a: _Value, b: _Value) -> tuple[Array, Array]:
    x = intervals.div(a.x, b.x)
    most = np.maximum(np.abs(x[0]), np.abs(x[1]))
    room = b.least - b.e
    return x, np.where(room > 0, (a.e + most * b.e) / room, np.inf)


def _sqrt(a: _Value) -> tuple[Array, Array]:
    low = a.least
    passed = np.minimum(np.sqrt(a.e), np.where(low > 0, a.e / np.sqrt(low), np.inf))
    return intervals.sqrt(a.x), np.where(a.e > low, np.inf, passed)


def _one() -> _Value:
    return _Value(intervals.constant(1.0), np.zeros(1))


_ROUNDED: dict[str, Callable[..., tuple[Array, Array]]] = {
    "add": lambda a, b: (intervals.add(a.x, b.x), a.e + b.e),
    "sub": lambda a, b: (intervals.sub(a.x, b.x), a.e + b.e),
    "mul": _mul,
    "sq": lambda a: (intervals.sq(a.x), 2 * a.e * a.most + a.e * a.e),
    "div": _div,
    "inv": lambda a: _div(_one(), a),
    "sqrt": _sqrt,
    "sin": lambda a: (intervals.sin(a.x), a.e),
    "cos": lambda a: (intervals.cos(a.x), a.e),
}


def _less(a: _Value, b: _Value, *, strict: bool) -> tuple[Array, Array]:
    x = intervals.lt(a.x, b.x) if strict else intervals.le(a.x, b.x)
    off = a.e + b.e
    apart = (a.x[1] + off < -b.x[0]) | (-a.x[0] - off > b.x[1]) | (off == 0)
    return x, np.where(apart, 0.0, 1.0)


def _same(a: _Value, b: _Value, *, equal: bool) -> tuple[Array, Array]:
    x = _logic(intervals.le(a.x, b.x), intervals.le(b.x, a.x))
    return (x if equal else intervals.not_(x)), _changed(a, b)


def _logic(a: Array, b: Array) -> Array:
    return intervals.mul(
        intervals.not_(intervals.not_(a)), intervals.not_(intervals.not_(b))
    )


def _either(a: Array, b: Array) -> Array:
    return intervals.not_(_logic(intervals.not_(a), intervals.not_(b)))


def _changed(*operands: _Value) -> Array:
    """1 where the truth of an operand may be computed wrongly."""
    off: Array = np.max(np.broadcast_arrays(*(v.e for v in operands)), axis=0)
    return np.where(off > 0, 1.0, 0.0)


def _sign(a: _Value) -> tuple[Array, Array]:
    return intervals.sign(a.x), np.where((a.least > a.e) | (a.e == 0), 0.0, 2.0)


def _select(c: _Value, a: _Value) -> tuple[Array, Array]:
    x = intervals.if_else_zero(c.x, a.x)
    return x, np.where(c.e > 0, a.most + a.e, a.e)


_EXACT: dict[str, Callable[..., tuple[Array, Array]]] = {
    "neg": lambda a: (intervals.neg(a.x), a.e),
    "twice": lambda a: (intervals.twice(a.x), 2 * a.e),
    "fabs": lambda a: (intervals.fabs(a.x), a.e),
    "fmin": lambda a, b: (intervals.fmin(a.x, b.x), np.maximum(a.e, b.e)),
    "fmax": lambda a, b: (intervals.fmax(a.x, b.x), np.maximum(a.e, b.e)),
    "sign": _sign,
    "lt": lambda a, b: _less(a, b, strict=True),
    "le": lambda a, b: _less(a, b, strict=False),
    "eq": lambda a, b: _same(a, b, equal=True),
    "ne": lambda a, b: _same(a, b, equal=False),
    "not": lambda a: (intervals.not_(a.x), _changed(a)),
    "and": lambda a, b: (_logic(a.x, b.x), _changed(a, b)),
    "or": lambda a, b: (_either(a.x, b.x), _changed(a, b)),
    "if_else_zero": _select,
}
