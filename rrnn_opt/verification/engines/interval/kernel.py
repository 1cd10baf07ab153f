"""Certain enclosures of a function over many boxes at once.

A tape becomes a C kernel that rounds outwards.  Nothing is assumed of the
compiler: every kernel that is loaded is first asked a few questions whose
answers differ when rounding is not directed.
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from rrnn_opt.emit.host import build, load
from rrnn_opt.emit.interval import FLAGS, interval_source
from rrnn_opt.errors import RrnnError, ShapeError
from rrnn_opt.symbolic.tape import Tape

Array = NDArray[np.float64]
BATCH = 4096
"""Boxes a call of the C kernel: its rows stay in the cache."""
_PAD = 8
_FINITE = 1e300
_NAME = "rrnn_interval"


@dataclass(frozen=True, eq=False)
class Enclosure:
    """Intervals that contain every value of a function over each of B boxes.

    Attributes:
        lower: (n_out, B).
        upper: (n_out, B).
        bounded: the function is defined all over the box and its enclosure is
            finite, (B,); where false, lower and upper say nothing.
    """

    lower: Array
    upper: Array
    bounded: NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class IntervalKernel:
    """A compiled tape over intervals; made by :meth:`of`.

    Attributes:
        tape: what it evaluates.
        n_in: number of input elements, over all ports.
        n_out: number of output elements.
    """

    tape: Tape
    n_in: int
    n_out: int
    _entry: Any

    @staticmethod
    def of(function: ca.Function | Tape) -> IntervalKernel:
        """Emit, compile (or find compiled), load and question a kernel.

        Raises:
            UnsupportedOperationError: intervals cannot do an operation.
            CompilerError: there is no compiler, or it fails.
            RrnnError: this machine does not round as it is told.
        """
        tape = function if isinstance(function, Tape) else Tape.of(function)
        _require_directed_rounding()
        entry = _compiled(interval_source(tape, _NAME))
        n_in = sum(port.size for port in tape.inputs)
        n_out = sum(port.size for port in tape.outputs)
        return IntervalKernel(tape, n_in, n_out, entry)

    def __call__(self, lower: Array, upper: Array) -> Enclosure:
        """Enclose the function over boxes.

        Args:
            lower: lower ends, (n_in, B).
            upper: upper ends, (n_in, B).

        Raises:
            ShapeError: the rows are not the inputs.
            RrnnError: this machine cannot set the rounding mode.
        """
        want = (self.n_in, np.shape(lower)[-1])
        for name, given in (("lower", lower), ("upper", upper)):
            if np.shape(given) != want:
                raise ShapeError(name, want, np.shape(given))
        count = want[1]
        low, high = np.empty((2, self.n_out, count))
        bounded = np.empty(count, bool)
        for start in range(0, count, BATCH):
            part = slice(start, min(start + BATCH, count))
            result = _run(self._entry, self.n_out, lower[:, part], upper[:, part])
            low[:, part], high[:, part], bounded[part] = result
        return Enclosure(low, high, bounded)


def _run(
    entry: Any, n_out: int, lower: Array, upper: Array
) -> tuple[Array, Array, NDArray[np.bool_]]:
    n_in, count = lower.shape
    size = -(-count // _PAD) * _PAD
    boxes = np.zeros((2, n_in, size))
    boxes[0, :, :count], boxes[1, :, :count] = lower, upper
    results, width = np.empty((2, n_out, size)), np.empty(size)
    where = (boxes[0], boxes[1], results[0], results[1], width)
    if entry(size, *(array.ctypes.data for array in where)):
        raise RrnnError("this machine cannot set the rounding mode: no interval proof")
    finite = np.all(np.isfinite(boxes[:, :, :count]), axis=(0, 1))
    bounded = (width[:count] < _FINITE) & finite
    return results[0, :, :count], results[1, :, :count], bounded


@lru_cache(maxsize=64)
def _compiled(source: str) -> Any:
    entry = load(build(source, name=_NAME, flags=FLAGS))[_NAME]
    entry.restype = ctypes.c_int
    entry.argtypes = (ctypes.c_size_t, *(ctypes.c_void_p,) * 5)
    return entry


@lru_cache(maxsize=1)
def _require_directed_rounding() -> None:
    """Both ends of 0.1 + 0.2, 0.1 * 0.1, 1 / 3 and sqrt 2 must differ by one ulp."""
    x, y = ca.SX.sym("x"), ca.SX.sym("y")
    asked = ca.vertcat(x + y, x - y, x * y, -x * y, x * x, 1 / (3 + x), y / x)
    function = ca.Function("asked", [x, y], [ca.vertcat(asked, ca.sqrt(2 + x))])
    tape = Tape.of(function)
    entry = _compiled(interval_source(tape, _NAME))
    point = np.array([[0.1], [3.3]])
    low, high, _ = _run(entry, 8, point, point)
    gap = (high - low)[:, 0] / np.spacing(np.abs(low[:, 0]))
    if not np.all((gap >= 1) & (gap <= 4)):
        raise RrnnError(
            "this compiler or machine does not round upwards when told to:"
            " interval proofs need one that does (gcc or clang on x86-64)"
        )
