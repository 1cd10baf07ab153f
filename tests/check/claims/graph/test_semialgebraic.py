"""What is taken to be known of a claim's atoms is true of their values."""

from __future__ import annotations

from fractions import Fraction

import casadi as ca
import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.check.claims.document import read_claim
from rrnn_opt.check.claims.graph.semialgebraic import semialgebraic
from rrnn_opt.claim import Claim, Hypothesis, Range, Relation
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification.document import claim_block

X, Y = Symbol.scalar("x"), Symbol.scalar("y")
x, y = X.sx, Y.sx
OPERATIONS = {
    "fmin": min,
    "fmax": max,
    "fabs": abs,
    "inv": lambda a: 1 / a,
    "le": lambda a, b: fmpq(a <= b),
    "lt": lambda a, b: fmpq(a < b),
    "eq": lambda a, b: fmpq(a == b),
    "ne": lambda a, b: fmpq(a != b),
    "not": lambda a: fmpq(a == 0),
    "and": lambda a, b: fmpq(a != 0 and b != 0),
    "or": lambda a, b: fmpq(a != 0 or b != 0),
    "if_else_zero": lambda a, b: b if a != 0 else fmpq(0),
}


def setting(expression, sense=">=0", **more):
    stated = Claim("T", "", "", (X, Y), Relation(expression, sense), **more)
    return semialgebraic(read_claim(claim_block(stated)))


def values(found, point):
    """The value of every generator at a point."""
    numbers = [fmpq(0)] * found.forms.ring.nvars()
    for index, slot in found.forms.variables.items():
        numbers[index] = point[slot[0]]
    for op, operands, atom in found.forms.atoms:
        (index,) = [k for k, d in enumerate(atom.degrees()) if d]
        numbers[index] = OPERATIONS[op](*(p(*numbers) for p in operands))
    return numbers


GRAPHS = [
    ca.fmin(ca.fmax(x, -y), 2 * y - 1),
    ca.fabs(x - y) + ca.fabs(x + 0.5),
    ca.if_else(x < y, x - 1, ca.if_else(ca.logic_or(x <= 0, y == 1), y, x + y)),
    ca.if_else(ca.logic_and(ca.logic_not(x < 1), y != x), x * y, -x),
    1 / (1 + x**2) + ca.if_else(x, y, 3),
]
small = st.fractions(-3, 3, max_denominator=4)


@pytest.mark.parametrize("expression", GRAPHS)
@settings(max_examples=60)
@given(small, small)
def test_laws_hold_at_every_point(expression, a, b):
    found = setting(expression)
    point = [fmpq(v.numerator, v.denominator) for v in (a, b)]
    numbers = values(found, point)
    assert all(g(*numbers) >= 0 for g in found.inequalities)
    assert all(h(*numbers) == 0 for h in found.equalities)
    assert found.inequalities or found.equalities


def test_domain_and_hypotheses_are_inequalities_and_equations():
    given_ = (
        Hypothesis("A1", "", Relation(ca.vertcat(x - 1, y), "<0")),
        Hypothesis("A2", "", Relation(x * y, "==0")),
    )
    box = (Range("x", (Fraction(-1, 3),), (None,)),)
    found = setting(x + y, hypotheses=given_, domain=box)
    seen = {str(p) for p in found.inequalities}
    assert len(seen) == 3
    (equation,) = found.equalities
    assert equation.total_degree() == 2


def test_sums_of_angles_are_equations():
    found = setting(ca.sin(x + y) - ca.sin(x) * ca.cos(y) - ca.cos(x) * ca.sin(y))
    assert found.goals[0] in [h * s for h in found.equalities for s in (1, -1)]
    turned = setting(ca.cos(x - y) + ca.sin(x) + ca.sin(y))
    assert len(turned.equalities) >= 2
