"""The operations of :mod:`~rrnn_opt.check.arithmetic.intervals`, ends being balls.

An interval is a pair of balls (Arb) of negligible radius, one that holds its
lower and one that holds its upper end.  Comparisons of balls are true only
when certain; what is not defined is NaN, and NaN stays NaN.
"""

from __future__ import annotations

from typing import Any

import flint

ARB = flint.arb
Ball = Any  # flint.arb: python-flint has no usable stubs
Ends = tuple[Ball, Ball]
_ZERO, _ONE = ARB(0), ARB(1)


def interval(lower: float, upper: float) -> Ends:
    """The interval with these ends."""
    return ARB(lower), ARB(upper)


def constant(value: float) -> Ends:
    """Exactly this number."""
    return ARB(value), ARB(value)


def _undefined() -> Ends:
    return ARB("nan"), ARB("nan")


def _is_nan(*operands: Ends) -> bool:
    return any(a[0].is_nan() or a[1].is_nan() for a in operands)


def add(a: Ends, b: Ends) -> Ends:
    """Sum."""
    return a[0] + b[0], a[1] + b[1]


def sub(a: Ends, b: Ends) -> Ends:
    """Difference."""
    return a[0] - b[1], a[1] - b[0]


def neg(a: Ends) -> Ends:
    """-a."""
    return -a[1], -a[0]


def twice(a: Ends) -> Ends:
    """2 a."""
    return a[0] + a[0], a[1] + a[1]


def mul(a: Ends, b: Ends) -> Ends:
    """Product: the extremes are among the products of the ends."""
    if a[0] >= 0 and b[0] >= 0:
        return a[0] * b[0], a[1] * b[1]
    p, q, r, s = a[0] * b[0], a[0] * b[1], a[1] * b[0], a[1] * b[1]
    return p.min(q).min(r.min(s)), p.max(q).max(r.max(s))


def sq(a: Ends) -> Ends:
    """Square."""
    b = fabs(a)
    return b[0] * b[0], b[1] * b[1]


def fabs(a: Ends) -> Ends:
    """Absolute value."""
    return a[0].max(-a[1]).max(_ZERO), a[1].max(-a[0])


def inv(a: Ends) -> Ends:
    """1 / a; NaN where a may be 0."""
    return (1 / a[1], 1 / a[0]) if a[0] > 0 or a[1] < 0 else _undefined()


def div(a: Ends, b: Ends) -> Ends:
    """Quotient; NaN where b may be 0."""
    return mul(a, inv(b))


def sqrt(a: Ends) -> Ends:
    """Square root; NaN where a may be negative."""
    return (a[0].sqrt(), a[1].sqrt()) if a[0] >= 0 else _undefined()


def fmin(a: Ends, b: Ends) -> Ends:
    """The smaller of two."""
    return a[0].min(b[0]), a[1].min(b[1])


def fmax(a: Ends, b: Ends) -> Ends:
    """The larger of two."""
    return a[0].max(b[0]), a[1].max(b[1])


def _truth(yes: bool, no: bool, *operands: Ends) -> Ends:
    if _is_nan(*operands):
        return _undefined()
    return (_ONE if yes else _ZERO), (_ZERO if no else _ONE)


def lt(a: Ends, b: Ends) -> Ends:
    """Whether a < b."""
    return _truth(a[1] < b[0], a[0] >= b[1], a, b)


def le(a: Ends, b: Ends) -> Ends:
    """Whether a <= b."""
    return _truth(a[1] <= b[0], a[0] > b[1], a, b)


def not_(a: Ends) -> Ends:
    """1 where a is 0."""
    return _truth(a[0] == 0 and a[1] == 0, a[0] > 0 or a[1] < 0, a)


def sign(a: Ends) -> Ends:
    """-1, 0 or 1; both ends of a jump where a may be 0."""
    if _is_nan(a):
        return _undefined()
    low = _ONE if a[0] > 0 else _ZERO if a[0] >= 0 else -_ONE
    high = -_ONE if a[1] < 0 else _ZERO if a[1] <= 0 else _ONE
    return low, high


def if_else_zero(c: Ends, a: Ends) -> Ends:
    """``a`` where c is not 0, else 0."""
    if _is_nan(c, a):
        return _undefined()
    if c[0] > 0 or c[1] < 0:
        return a
    if c[0] == 0 and c[1] == 0:
        return _ZERO, _ZERO
    return a[0].min(_ZERO), a[1].max(_ZERO)


def sin(a: Ends) -> Ends:
    """Sine."""
    return _wave(a[0].sin(), a[1].sin(), a, ARB(1) / 4)


def cos(a: Ends) -> Ends:
    """Cosine."""
    return _wave(a[0].cos(), a[1].cos(), a, _ZERO)


def _wave(first: Ball, last: Ball, a: Ends, top: Ball) -> Ends:
    """Values at both ends, and the crests and troughs between them."""
    turns = a[0].union(a[1]) / (2 * ARB.pi()) - top
    if turns.is_nan():
        return _undefined()
    high = _ONE if turns.contains_integer() else first.max(last)
    half = turns - ARB(1) / 2
    return (-_ONE if half.contains_integer() else first.min(last)), high


def union(a: Ends, b: Ends) -> Ends:
    """Smallest interval that holds both."""
    return a[0].min(b[0]), a[1].max(b[1])


def meet(a: Ends, b: Ends) -> Ends:
    """What two enclosures of the same values have in common."""
    return a[0].max(b[0]), a[1].min(b[1])


def lower(a: Ends) -> Ball:
    """Lower end."""
    return a[0]


def upper(a: Ends) -> Ball:
    """Upper end."""
    return a[1]
