"""Intervals of doubles, rounded outwards, many at a time.

An interval [a, b] is held as the rows (-a, b) of an array (2, B), so that both
ends are rounded the same way: upwards.  ``+ - * /`` and sqrt give the nearest
double r of the exact x (IEEE 754), hence |x - r| <= 2^-53 |r| unless r underflows,
and ``r + 2^-52 |r|`` is no less than x even after its own rounding, being no less
than r's upper neighbour.  Sums and roots do not underflow (a subnormal sum is
exact); products and inverses that may do so get 1e-290 on top.  What is not
defined somewhere in a box is NaN, and NaN stays NaN.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.check.arithmetic import sincos

Array = NDArray[np.float64]
Interval = Array
"""(2, B): minus the lower ends, and the upper ends."""

LARGEST_ANGLE = 1e5
_U, _TINY, _SMALL = 2.0**-52, 1e-290, 1e-250
_SLACK = 1e-9  # turns; far more than the error of an angle in turns


def interval(lower: Array, upper: Array) -> Interval:
    """Intervals with these ends."""
    return np.stack([-lower, upper])


def constant(value: float) -> Interval:
    """One number for all boxes."""
    return np.array([[-value], [value]])


def _up(x: Array) -> Array:
    e = np.abs(x)
    e *= _U
    e += x
    return e


def _up_product(x: Array, a: Interval, b: Interval) -> Array:
    """As :func:`_up` for products of ends of a and b, which may underflow."""
    small = np.abs(x) < _SMALL
    if np.any(small):
        safe = _smallest(a) * _smallest(b) > _SMALL
        x = _up(x) + np.where(small & ~safe, _TINY, 0.0)
        return x
    return _up(x)


def _smallest(a: Interval) -> Array:
    """Least absolute value of an end that is not 0."""
    smallest: Array = np.min(np.where(a == 0.0, np.inf, np.abs(a)), axis=0)
    return smallest


def add(a: Interval, b: Interval) -> Interval:
    """Sum."""
    return _up(a + b)


def sub(a: Interval, b: Interval) -> Interval:
    """Difference."""
    return _up(a + b[::-1])


def neg(a: Interval) -> Interval:
    """-a."""
    return a[::-1]


def twice(a: Interval) -> Interval:
    """2 a, exactly."""
    return a + a


def mul(a: Interval, b: Interval) -> Interval:
    """Product: the extremes are among the products of the ends."""
    nn, nh, hn, hh = a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]
    up = np.maximum(np.maximum(nn, hh), -np.minimum(nh, hn))
    down = np.maximum(np.maximum(nh, hn), -np.minimum(nn, hh))
    return _up_product(np.stack([down, up]), a, b)


def least(a: Interval) -> Array:
    """Least absolute value."""
    smallest: Array = np.maximum(np.maximum(-a[0], -a[1]), 0.0)
    return smallest


def sq(a: Interval) -> Interval:
    """Square."""
    most, low = np.maximum(a[0], a[1]), least(a)
    return _up_product(np.stack([-low * low, most * most]), a, a)


def fabs(a: Interval) -> Interval:
    """Absolute value."""
    return np.stack([-least(a), np.maximum(a[0], a[1])])


def inv(a: Interval) -> Interval:
    """1 / a; NaN where a may be 0."""
    apart = (a[0] < 0) | (a[1] < 0)
    safe = np.where(apart, a, np.nan)
    return _up(-1.0 / safe[::-1]) + _TINY


def div(a: Interval, b: Interval) -> Interval:
    """Quotient; NaN where b may be 0."""
    return mul(a, inv(b))


def sqrt(a: Interval) -> Interval:
    """Square root; NaN where a may be negative."""
    safe = np.where(a[0] <= 0, a, np.nan)
    return _up(np.stack([-np.sqrt(np.abs(safe[0])), np.sqrt(safe[1])]))


def fmin(a: Interval, b: Interval) -> Interval:
    """The smaller of two."""
    return np.stack([np.maximum(a[0], b[0]), np.minimum(a[1], b[1])])


def fmax(a: Interval, b: Interval) -> Interval:
    """The larger of two."""
    return np.stack([np.minimum(a[0], b[0]), np.maximum(a[1], b[1])])


def _truth(yes: Any, no: Any, *operands: Interval) -> Interval:
    """1 where something is certain, 0 where it is excluded, else [0, 1]."""
    known = ~np.isnan(sum(np.add(x[0], x[1]) for x in operands))
    rows = np.stack([np.where(yes, -1.0, 0.0), np.where(no, 0.0, 1.0)])
    return np.where(known, rows, np.nan)


def lt(a: Interval, b: Interval) -> Interval:
    """Whether a < b."""
    return _truth(a[1] < -b[0], -a[0] >= b[1], a, b)


def le(a: Interval, b: Interval) -> Interval:
    """Whether a <= b."""
    return _truth(a[1] <= -b[0], -a[0] > b[1], a, b)


def not_(a: Interval) -> Interval:
    """1 where a is 0."""
    zero = (a[0] == 0) & (a[1] == 0)
    return _truth(zero, (a[0] < 0) | (a[1] < 0), a)


def sign(a: Interval) -> Interval:
    """-1, 0 or 1; both ends of a jump where a may be 0."""
    up = np.where(a < 0, -1.0, np.where(a > 0, 1.0, 0.0))
    return np.where(np.isnan(a), np.nan, up)


def if_else_zero(c: Interval, a: Interval) -> Interval:
    """``a`` where c is not 0, else 0."""
    never, always = (c[0] == 0) & (c[1] == 0), (c[0] < 0) | (c[1] < 0)
    rows = np.where(always, a, np.where(never, 0.0, np.maximum(a, 0.0)))
    return np.where(np.isnan(a) | np.isnan(c), np.nan, rows)


def sin(a: Interval) -> Interval:
    """Sine."""
    return _wave(a, 0, 0.25)


def cos(a: Interval) -> Interval:
    """Cosine."""
    return _wave(a, 1, 0.0)


def _wave(a: Interval, which: int, top: float) -> Interval:
    near = np.all(np.abs(a) <= LARGEST_ANGLE, axis=0)
    low, high = np.where(near, -a[0], 0.0), np.where(near, a[1], 0.0)
    first, last = sincos.sincos(low)[which], sincos.sincos(high)[which]
    turns = low / (2 * np.pi), high / (2 * np.pi)
    rows = []
    for sense, crest in ((-1.0, top + 0.5), (1.0, top)):
        most = np.maximum(sense * first, sense * last) + 2 * sincos.ERROR
        reached = np.floor(turns[1] - crest + _SLACK) >= turns[0] - crest - _SLACK
        rows.append(np.where(near & ~reached, np.minimum(most, 1.0), 1.0))
    return np.where(np.isnan(a), np.nan, np.stack(rows))


def union(a: Interval, b: Interval) -> Interval:
    """Smallest interval that holds both."""
    both: Interval = np.maximum(a, b)
    return both


def meet(a: Interval, b: Interval) -> Interval:
    """What two enclosures of the same values have in common."""
    common: Interval = np.fmin(a, b)  # where one is NaN, the other holds
    return common


def lower(a: Interval) -> Array:
    """Lower ends, (B,)."""
    ends: Array = -a[0]
    return ends


def upper(a: Interval) -> Array:
    """Upper ends, (B,)."""
    ends: Array = a[1]
    return ends
