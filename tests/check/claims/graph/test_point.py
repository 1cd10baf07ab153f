"""Replays: exact where rational, certain signs elsewhere."""

from __future__ import annotations

import math
from fractions import Fraction

import casadi as ca
import numpy as np
import pytest

from rrnn_opt.check.claims.document import ClaimGraph, read_claim
from rrnn_opt.check.claims.graph.point import replay
from rrnn_opt.claim import Claim, Relation
from rrnn_opt.errors import UndecidedError
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification.document import claim_block

SYMBOLS = [Symbol.scalar(name) for name in "xyz"]
x, y, z = (symbol.sx for symbol in SYMBOLS)


def graph_of(expression: ca.SX) -> ClaimGraph:
    goal = Relation(expression, "==0")
    return read_claim(claim_block(Claim("T", "", "", tuple(SYMBOLS), goal)))


def at(a, b=0, c=0):
    return {(k, 0): Fraction(v) for k, v in enumerate((a, b, c))}


def seen(expression, *point):
    found = replay(graph_of(expression), at(*point))
    return found.signs[0][0], found.trust


@pytest.mark.parametrize(
    ("expression", "point", "sign"),
    [
        (x * y - 1, (Fraction(1, 3), 3), 0),
        (0.1 * x - y, (10, 1), 1),  # the double 0.1 is larger than 1/10
        (ca.fmin(x, y) - ca.fmax(x, y), (2, 3), -1),
        (ca.floor(x) + 2, (Fraction(-3, 2),), 0),
        (ca.ceil(x) + 1, (Fraction(-3, 2),), 0),
        (ca.if_else(x < y, x, y) - 2, (2, 3), 0),
        (ca.fabs(x) - 2 + ca.sign(y), (-2, -5), -1),
        (x**3 / y, (-2, 4), -1),
        (ca.logic_and(x > 0, ca.logic_not(y > 0)) - 1, (1, 0), 0),
    ],
)
def test_rational_graphs_are_exact(expression, point, sign):
    assert seen(expression, *point) == (sign, "exact")


def test_a_difference_far_below_double_precision_is_seen():
    tiny = Fraction(1, 10**60)
    assert seen(ca.sin(x) - ca.sin(y), 1 + tiny, 1) == (1, "arb")
    assert seen(ca.sin(x) - ca.sin(y), 1 - tiny, 1) == (-1, "arb")


def test_an_open_sign_is_not_guessed():
    with pytest.raises(UndecidedError, match="open"):
        seen(ca.sin(x + y) ** 2 + ca.cos(y + x + z) ** 2 - 1, 1)


@pytest.mark.parametrize(
    "expression", [ca.sqrt(x), ca.log(x), x / (ca.cos(y) - 1), ca.acos(x - 1)]
)
def test_where_it_is_not_defined_nothing_is_said(expression):
    with pytest.raises(UndecidedError):
        seen(expression, -1, 0)


def test_division_by_zero():
    with pytest.raises(UndecidedError, match="zero"):
        seen(x / y, 1, 0)


UNARY = {
    "sqrt": ca.sqrt, "exp": ca.exp, "log": ca.log, "sin": ca.sin, "cos": ca.cos,
    "tan": ca.tan, "asin": ca.asin, "acos": ca.acos, "atan": ca.atan, "sinh": ca.sinh,
    "cosh": ca.cosh, "tanh": ca.tanh, "log1p": ca.log1p, "expm1": ca.expm1,
}  # fmt: skip


@pytest.mark.parametrize("name", sorted(UNARY))
def test_balls_agree_with_the_c_library(name):
    """The value lies between the library's, moved by a few last bits."""
    value = getattr(
        np, {"asin": "arcsin", "acos": "arccos", "atan": "arctan"}.get(name, name)
    )(0.625)
    gap = 8 * math.ulp(float(value))
    expression = UNARY[name](x) - y
    assert seen(expression, Fraction(5, 8), Fraction(float(value) - gap))[0] == 1
    assert seen(expression, Fraction(5, 8), Fraction(float(value) + gap))[0] == -1


def test_two_argument_operations_agree_with_the_c_library():
    for op, value in (
        (ca.atan2(x, y), math.atan2(0.5, -0.75)),
        (ca.hypot(x, y), math.hypot(0.5, -0.75)),
        (ca.copysign(x, y) + ca.sin(z) * 0, -0.5),
        (ca.constpow(x, y), 0.5**-0.75),
    ):
        for sign in (1, -1):
            shifted = Fraction(value) - sign * Fraction(1, 10**12)
            point = (Fraction(1, 2), Fraction(-3, 4), shifted)
            assert seen(op - z, *point)[0] == sign
