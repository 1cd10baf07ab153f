"""Sums of lemmas: each ingredient of a true one is spoilt in turn.

The goals are settled by hand; a combination is believed where it is a proof and
nowhere else, also where the goal happens to be true.
"""

from __future__ import annotations

from fractions import Fraction

import casadi as ca
import pytest

from rrnn_opt.check.claims.document import read_claim
from rrnn_opt.check.claims.methods.combination import Lemma, combine
from rrnn_opt.claim import Claim, Hypothesis, Range, Relation
from rrnn_opt.errors import DocumentError, UndecidedError
from rrnn_opt.symbolic import Symbol
from rrnn_opt.symbolic.tape import Tape
from rrnn_opt.verification.document import claim_block, port_row, step_row

X, Y = Symbol.scalar("x"), Symbol.scalar("y")
x, y = X.sx, Y.sx


def graph(expression, sense="==0", *, given=(), low=None, high=None):
    """A claim of x and y as the checker reads it; the range is that of x."""
    hypotheses = tuple(
        Hypothesis(f"H{k}", "", Relation(value, how)) for k, (value, how) in
        enumerate(given)
    )  # fmt: skip
    bounds = [None if b is None else Fraction(b) for b in (low, high)]
    domain = () if bounds == [None, None] else (Range("x", *((b,) for b in bounds)),)
    goal = Relation(ca.SX(expression), sense)
    stated = Claim("T", "", "", (X, Y), goal, hypotheses, domain)
    return read_claim(claim_block(stated))


def data(expressions, *elements):
    """A combination: expressions of x and y, then terms, goal by goal."""
    names = [f"r{k}" for k in range(len(expressions))]
    values = [ca.SX(e) for e in expressions]
    tape = Tape.of(ca.Function("p", [x, y], values, ["x", "y"], names))
    return {
        "inputs": [port_row(port) for port in tape.inputs],
        "outputs": [port_row(port) for port in tape.outputs],
        "tape": [step_row(step) for step in tape.instructions],
        "elements": list(elements),
    }


def lemma(*arguments, **more):
    return Lemma(graph(*arguments, **more), (), "exact")


def use(arguments, factor, *, part=0, element=0):
    return {"use": "lemma", "part": part, "element": element,
            "arguments": list(arguments), "factor": factor}  # fmt: skip


def of_hypothesis(factor, output=1, element=0):
    return {
        "use": "hypothesis",
        "output": output,
        "element": element,
        "factor": factor,
    }


def square(of, factor):
    return {"use": "square", "of": of, "factor": factor}


def proved(claim, expressions, *elements, lemmas=()):
    """Whether the combination is believed; other errors pass through."""
    try:
        combine(claim, data(expressions, *elements), lemmas)
    except UndecidedError:
        return False
    return True


# x^2 - 2xy + 2y^2 = (x - y)^2 + y^2
SQUARES = [square(0, 2), square(1, 2)]


@pytest.mark.parametrize(
    ("expression", "sense", "believed"),
    [
        (x**2 - 2 * x * y + 2 * y**2, ">=0", True),
        (x**2 - 2 * x * y + 2 * y**2, ">0", False),  # 0 at 0
        (x**2 - 2 * x * y + 2 * y**2 + 1, ">0", True),
        (x**2 - 2 * x * y + 2 * y**2 - 1, ">=0", False),
        (2 * x * y - x**2 - 2 * y**2, "<=0", True),
        (2 * x * y - x**2 - 2 * y**2, ">=0", False),
        (2 * x * y - x**2 - 2 * y**2, "<0", False),
        (2 * x * y - x**2 - 2 * y**2 - 1, "<0", True),
        (x**2 + 2 * x * y + 2 * y**2, ">=0", False),  # true, but not by these squares
    ],
)
def test_a_sum_of_squares_settles_the_sign_that_it_has(expression, sense, believed):
    assert proved(graph(expression, sense), (x - y, y, 1), SQUARES) is believed


@pytest.mark.parametrize(
    ("factor", "believed"), [(1, True), (0, False), (-1, False), (2, False)]
)
def test_an_identity_sums_up_exactly(factor, believed):
    """x^2 - y^2 = (x + y)(x - y), where x - y = 0 is given."""
    claim = graph(x**2 - y**2, given=[(x - y, "==0")])
    terms = [of_hypothesis(0)]
    assert proved(claim, (factor * (x + y),), terms) is believed


@pytest.mark.parametrize(
    ("factor", "believed"), [(1, True), (y**2, True), (y, False), (-1, False)]
)
def test_the_factor_of_an_inequality_is_never_negative(factor, believed):
    """factor * x >= 0 from x >= 0; an equation would take any factor."""
    claim = graph(factor * x, ">=0", given=[(x, ">=0")])
    assert proved(claim, (factor,), [of_hypothesis(0)]) is believed
    equation = graph(factor * x, given=[(x, "==0")])
    assert proved(equation, (factor,), [of_hypothesis(0)])


@pytest.mark.parametrize(
    ("sense", "believed"), [("<=0", True), ("<0", True), (">=0", False)]
)
def test_a_hypothesis_that_points_down_is_turned_round(sense, believed):
    """-x >= 0 from x <= 0, and not from x >= 0."""
    claim = graph(-x, ">=0", given=[(x, sense)])
    assert proved(claim, (1,), [of_hypothesis(0)]) is believed


POSITIVE = lemma(x * y, ">=0", given=[(x, ">=0"), (y, ">=0")])
"""x >= 0 and y >= 0 make x y >= 0: false without either."""


@pytest.mark.parametrize(
    ("given", "believed"),
    [
        ([(x, ">=0"), (y, ">=0")], True),
        ([(x, ">0"), (y, ">=0")], True),
        ([(x - 1, ">=0"), (y, ">=0")], True),
        ([(-x, "<=0"), (y, ">=0")], True),
        ([(x + 1, ">=0"), (y, ">=0")], False),
        ([(x, "<=0"), (y, ">=0")], False),
        ([(x, ">=0")], False),
        ([], False),
    ],
)
def test_a_lemma_is_used_where_its_hypotheses_are_given(given, believed):
    claim = graph(x * y, ">=0", given=given)
    terms = [use([0, 1], 2)]
    assert proved(claim, (x, y, 1), terms, lemmas=[POSITIVE]) is believed


STRICT = lemma(x, ">0", given=[(x, ">0")])


@pytest.mark.parametrize(
    ("value", "sense", "believed"),
    [(x, ">0", True), (x, ">=0", False), (x - 1, ">=0", True), (x, "==0", False)],
)
def test_a_strict_hypothesis_asks_for_a_strict_one(value, sense, believed):
    claim = graph(x, ">=0", given=[(value, sense)])
    assert proved(claim, (x, y, 1), [use([0, 1], 2)], lemmas=[STRICT]) is believed


RANGED = lemma(x * (1 - x), ">=0", low=0, high=1)
"""x (1 - x) >= 0 for 0 <= x <= 1 only."""


@pytest.mark.parametrize(
    ("low", "high", "believed"),
    [(0, 1, True), ("1/4", "3/4", True), ("-1/9", 1, False), (0, "10/9", False),
     (None, 1, False), (0, None, False)],
)  # fmt: skip
def test_a_lemma_with_a_range_is_used_inside_it(low, high, believed):
    claim = graph(x * (1 - x), ">=0", low=low, high=high)
    terms = [use([0, 1], 2)]
    assert proved(claim, (x, y, 1), terms, lemmas=[RANGED]) is believed


def test_a_lemma_is_turned_to_its_arguments():
    """From a b >= 0 at (y, x + 1), whose signs are given: not at (x + 1, x)."""
    claim = graph(y * (x + 1), ">=0", given=[(y, ">=0"), (x + 1, ">=0")])
    expressions = (y, x + 1, 1, x)
    assert proved(claim, expressions, [use([0, 1], 2)], lemmas=[POSITIVE])
    assert proved(claim, expressions, [use([1, 0], 2)], lemmas=[POSITIVE])
    assert not proved(claim, expressions, [use([0, 3], 2)], lemmas=[POSITIVE])


def test_every_element_of_the_goal_has_terms_of_its_own():
    claim = graph(ca.vertcat(x**2, y**2), ">=0")
    first, second = [square(0, 2)], [square(1, 2)]
    assert proved(claim, (x, y, 1), first, second)
    assert not proved(claim, (x, y, 1), second, second)
    assert not proved(claim, (x, y, 1), first)
    assert not proved(claim, (x, y, 1), first, second, first)


@pytest.mark.parametrize(
    "term",
    [of_hypothesis(0, output=0), of_hypothesis(0, output=2),
     of_hypothesis(0, element=1), of_hypothesis(0, element=-1)],
)  # fmt: skip
def test_the_goal_is_no_hypothesis_of_itself(term):
    """Output 0 is the goal; 2, and other elements, are not there."""
    claim = graph(x, ">=0", given=[(x + 1, ">=0")])
    assert not proved(claim, (1, y), [term])


@pytest.mark.parametrize("count", [0, 1, 3])
def test_a_lemma_takes_as_many_arguments_as_it_has_variables(count):
    claim = graph(x * y, ">=0", given=[(x, ">=0"), (y, ">=0")])
    terms = [use(range(count), 2)]
    assert not proved(claim, (x, y, 1), terms, lemmas=[POSITIVE])


@pytest.mark.parametrize(
    "term", [square(-1, 0), square(0, -1), {"use": "hope", "factor": 0}]
)
def test_terms_that_cannot_be_read_are_refused(term):
    with pytest.raises(DocumentError):
        combine(graph(x**2, ">=0"), data((x, 1), [term]), ())


def test_expressions_of_other_variables_are_refused():
    rows = data((x - y, y, 1), SQUARES)
    rows["inputs"] = [[name + "_", *rest] for name, *rest in rows["inputs"]]
    with pytest.raises(UndecidedError, match="not of the claim's variables"):
        combine(graph(x**2 - 2 * x * y + 2 * y**2, ">=0"), rows, ())
