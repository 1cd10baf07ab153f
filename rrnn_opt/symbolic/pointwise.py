"""Element-wise helpers that work on SX and on numpy alike."""

from __future__ import annotations

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from rrnn_opt.symbolic.symbol import Value

Array = NDArray[np.float64]
Truth = ca.SX | bool


def is_symbolic(*values: Value) -> bool:
    """Whether at least one of the values is an SX expression."""
    return any(isinstance(v, ca.SX) for v in values)


def like(side: Value, x: Value) -> Array:
    """A numeric side in the shape of the point."""
    return np.asarray(side, dtype=np.float64).reshape(x.shape)


def is_small(gap: Value, tolerance: float) -> Truth:
    """Whether all elements are within ``tolerance`` of zero."""
    if isinstance(gap, ca.SX):
        return ca.mmin(ca.fabs(gap) <= tolerance)
    return bool(np.all(np.abs(gap) <= tolerance))


def clip(x: ca.SX, lower: ca.SX, upper: ca.SX) -> ca.SX:
    """``min(max(x, lower), upper)`` without the sides that are infinite."""
    parts: list[ca.SX] = []
    for value, low, high in zip(
        ca.vertsplit(x), ca.vertsplit(lower), ca.vertsplit(upper), strict=True
    ):
        if not _is(low, -np.inf):
            value = ca.fmax(value, low)
        if not _is(high, np.inf):
            value = ca.fmin(value, high)
        parts.append(value)
    return ca.vertcat(*parts)


def _is(element: ca.SX, number: float) -> bool:
    return bool(element.is_constant()) and float(element) == number
