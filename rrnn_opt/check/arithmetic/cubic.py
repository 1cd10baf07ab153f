"""Whether a cubic piece keeps a limit, decided in rational arithmetic.

Over the piece's own time x from 0 to 1, with D = q1 - q0 and V = h qd, all of
them rational numbers,

    q(x) = q0 + V0 x + (3 D - 2 V0 - V1) x^2 + (V0 + V1 - 2 D) x^3.

A velocity's extreme is rational.  A position's lies at r = (-b + sqrt(d)) / 2a:
the cubic there is x + y sqrt(d), whose sign follows from squares.  Nothing is
rounded, so there is always an answer.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

Coefficients = tuple[Fraction, Fraction, Fraction, Fraction]
ORDERS = {"position": 0, "velocity": 1, "acceleration": 2}


def keeps(
    kind: str, t: Sequence[float], q: Sequence[float], qd: Sequence[float], most: float
) -> bool:
    """Whether the position, velocity or acceleration is nowhere above ``most``.

    Args:
        kind: "position", "velocity" or "acceleration".
        t: both times, s.
        q: both positions, rad or m.
        qd: both velocities.
        most: in the kind's unit.
    """
    h = Fraction(float(t[1])) - Fraction(float(t[0]))
    c0, c1, c2, c3 = coefficients(h, q, qd)
    bound = Fraction(most)
    if kind == "position":
        return _cubic_kept((bound - c0, -c1, -c2, -c3))
    if kind == "velocity":
        return _quadratic_kept(bound * h - c1, -2 * c2, -3 * c3)
    least = bound * h * h - 2 * c2
    return least >= 0 and least - 6 * c3 >= 0


def coefficients(h: Fraction, q: Sequence[float], qd: Sequence[float]) -> Coefficients:
    """c0 .. c3 of the cubic over x."""
    start, end = Fraction(float(q[0])), Fraction(float(q[1]))
    first, last = h * Fraction(float(qd[0])), h * Fraction(float(qd[1]))
    move = end - start
    return start, first, 3 * move - 2 * first - last, first + last - 2 * move


def _quadratic_kept(a: Fraction, b: Fraction, c: Fraction) -> bool:
    """Whether a + b x + c x^2 >= 0 on [0, 1]."""
    if a < 0 or a + b + c < 0:
        return False
    inside = c > 0 and -2 * c < b < 0  # the least value lies between the ends
    return not inside or 4 * a * c >= b * b


def _cubic_kept(p: Coefficients) -> bool:
    """Whether p0 + p1 x + p2 x^2 + p3 x^3 >= 0 on [0, 1]."""
    if p[0] < 0 or sum(p) < 0:
        return False
    a, b, c = 3 * p[3], 2 * p[2], p[1]
    if a == 0:
        return _quadratic_kept(p[0], p[1], p[2])
    d = b * b - 4 * a * c
    if d <= 0:
        return True
    # the only inner minimum is r = (-b + sqrt d) / 2a, where p' rises
    scale = 1 / (2 * a)
    if _sign(-b * scale, scale, d) <= 0 or _sign(1 + b * scale, -scale, d) <= 0:
        return True
    # p modulo p' is the line u + v x
    u, v = p[0] - b * c / (18 * p[3]), 2 * c / 3 - b * b / (18 * p[3])
    return _sign(u - v * b * scale, v * scale, d) >= 0


def _sign(x: Fraction, y: Fraction, d: Fraction) -> int:
    """Sign of x + y sqrt(d), d > 0."""
    one, two = (x > 0) - (x < 0), (y > 0) - (y < 0)
    if one == two or two == 0:
        return one
    if one == 0:
        return two
    square = x * x - y * y * d
    return one * ((square > 0) - (square < 0))
