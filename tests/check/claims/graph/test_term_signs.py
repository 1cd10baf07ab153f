"""Signs seen term by term, beside exact values on the domain's corners and inside."""

from __future__ import annotations

from fractions import Fraction
from itertools import product

import casadi as ca
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.check.claims.document import read_claim
from rrnn_opt.check.claims.graph.polynomial import normal_forms
from rrnn_opt.check.claims.graph.term_signs import never_negative
from rrnn_opt.claim import Claim, Relation
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification.document import claim_block

SYMBOLS = (Symbol.scalar("x"), Symbol.scalar("y"))
x, y = (symbol.sx for symbol in SYMBOLS)
UP, DOWN, FREE = (Fraction(0), None), (None, Fraction(0)), (None, None)
ACROSS, FAR, BELOW = (
    (Fraction(-1), Fraction(1)),
    (Fraction(2), None),
    (None, Fraction(-1)),
)
REACHED = {
    UP: (0, 1, 7), DOWN: (0, -1, -7), FREE: (0, -3, 5), ACROSS: (0, -1, 1),
    FAR: (2, 9), BELOW: (-1, -9),
}  # fmt: skip
"""Points of each range, the worst among them."""


def seen(expression, ranges, *, strict=False):
    goal = Relation(ca.SX(expression), "==0")
    graph = read_claim(claim_block(Claim("T", "", "", SYMBOLS, goal)))
    forms = normal_forms(graph)
    domain = {(k, 0): ends for k, ends in enumerate(ranges) if ends != FREE}
    return never_negative(forms.results.get((0, 0), 0), forms, domain, strict=strict)


@pytest.mark.parametrize(
    ("expression", "ranges", "expected"),
    [
        (x, (UP, FREE), True),
        (x, (FAR, FREE), True),
        (x, (FREE, FREE), False),
        (x, (ACROSS, FREE), False),
        (x, (DOWN, FREE), False),
        (-x, (DOWN, FREE), True),
        (-x, (BELOW, FREE), True),
        (-x, (UP, FREE), False),
        (x**3, (UP, FREE), True),
        (x**3 * y, (DOWN, DOWN), True),
        (x**3 * y, (UP, DOWN), False),
        (-(x**3) * y, (UP, DOWN), True),
        (x**2, (FREE, FREE), True),
        (-(x**2), (FREE, FREE), False),
        (x**2 * y, (FREE, UP), True),
        (x**2 * y**4, (FREE, FREE), True),
        (x + y, (UP, FREE), False),
        (ca.exp(x), (UP, FREE), False),  # true, but an atom's sign is not known here
        (ca.exp(x) ** 2, (FREE, FREE), True),
        (x - x, (FREE, FREE), True),
        (-1, (UP, UP), False),
    ],
)
def test_a_sign_is_seen_where_every_term_has_it(expression, ranges, expected):
    assert seen(expression, ranges) is expected


@pytest.mark.parametrize(
    ("expression", "expected"),
    [(x**2, False), (x**2 + 1, True), (x**2 - 1, False), (x - x, False), (2, True)],
)
def test_a_positive_constant_makes_it_strict(expression, expected):
    assert seen(expression, (FREE, FREE), strict=True) is expected


terms = st.lists(
    st.tuples(st.integers(-3, 3), st.integers(0, 4), st.integers(0, 4)), max_size=4
)
ends = st.sampled_from(sorted(REACHED, key=str))


@settings(max_examples=60)
@given(terms, ends, ends, st.booleans())
def test_what_is_seen_is_true_at_every_point(terms, first, second, strict):
    total = sum((c * x**i * y**k for c, i, k in terms), ca.SX(0))
    if seen(total, (first, second), strict=strict):
        for a, b in product(REACHED[first], REACHED[second]):
            value = sum(c * a**i * b**k for c, i, k in terms)
            assert value > 0 if strict else value >= 0
