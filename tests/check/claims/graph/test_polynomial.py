"""Normal forms against exact rational evaluation and known identities."""

from __future__ import annotations

from fractions import Fraction

import casadi as ca
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.check.claims.document import ClaimGraph, Step, read_claim
from rrnn_opt.check.claims.graph.polynomial import normal_forms
from rrnn_opt.claim import Claim, Relation
from rrnn_opt.errors import UndecidedError
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification.document import claim_block

SYMBOLS = [Symbol.scalar(name) for name in "xyz"]
x, y, z = (symbol.sx for symbol in SYMBOLS)


def graph_of(expression: ca.SX) -> ClaimGraph:
    goal = Relation(expression, "==0")
    return read_claim(claim_block(Claim("T", "", "", tuple(SYMBOLS), goal)))


def vanishes(expression: ca.SX) -> bool:
    return all(p == 0 for p in normal_forms(graph_of(expression)).results.values())


@pytest.mark.parametrize(
    "expression",
    [
        (x + y) ** 2 - x**2 - 2 * x * y - y**2,
        ca.sin(x) ** 2 + ca.cos(x) ** 2 - 1,
        ca.cos(x * y) ** 4 - (1 - ca.sin(y * x) ** 2) ** 2,
        ca.sin(-x) + ca.sin(x),
        ca.cos(x - y) - ca.cos(y - x),
        ca.fmin(x, y) * 2 - ca.fmin(y, x) - ca.fmin(x, y),
        ca.fmax(x * x - y * y, z) - ca.fmax((x - y) * (x + y), z),
        ca.fmin(x, x + 1) - x,
        x / 4 - 0.25 * x,
        (x + y) / z - x / z - y / z,
        ca.exp(2 * x + y) - ca.exp(y + x + x),
    ],
)
def test_true_identities_vanish(expression):
    assert vanishes(expression)


@pytest.mark.parametrize(
    "expression",
    [
        (x + y) ** 2 - x**2 - y**2,
        ca.sin(x) ** 2 + ca.cos(y) ** 2 - 1,
        ca.sin(x) + ca.sin(y),
        ca.fmin(x, y) - ca.fmax(x, y),
        0.1 * x * 3 - 0.3 * x,  # the doubles 0.1 and 0.3 are no tenths
        ca.fmin(x, y) - ca.fmin(x, y + 1e-300),
        ca.sqrt(x * x) - x,
        (x * y + x * z) / x - y - z,  # true where defined, but not for this method
        ca.fmin(x, x + 1) - x - 1,
    ],
)
def test_what_is_not_an_identity_does_not_vanish(expression):
    assert not vanishes(expression)


def test_partial_operations_are_named_even_where_they_cancel():
    cancelled = (ca.log(x * y) + z / y) * x - (x * ca.log(y * x) + x * (z / y))
    forms = normal_forms(graph_of(cancelled))
    assert all(p == 0 for p in forms.results.values())
    assert set(forms.partial) == {"inv", "log"}
    assert normal_forms(graph_of(x / 3 - y)).partial == ()


@pytest.mark.parametrize("value", [float("inf"), float("nan")])
def test_constants_that_are_no_numbers_settle_nothing(value):
    with pytest.raises(UndecidedError, match="not a real number"):
        normal_forms(graph_of(ca.fmin(x, value) - ca.fmin(x, value) + y * value))


def test_division_by_a_zero_that_is_one_after_expansion():
    with pytest.raises(UndecidedError, match="divides by zero"):
        normal_forms(graph_of(y / ((x + z) ** 2 - x**2 - z**2 - 2 * x * z)))


def test_the_budget_is_kept():
    with pytest.raises(UndecidedError, match="budget"):
        normal_forms(graph_of((x + y + z + 1) ** 32), work=1000)


def test_an_unknown_operation_settles_nothing():
    graph = graph_of(x + y)
    steps = tuple(
        Step("magic" if s.op == "add" else s.op, s.out, s.args, s.const, s.slot)
        for s in graph.steps
    )
    broken = ClaimGraph(graph.inputs, graph.outputs, steps, ("==0",), (), (), {}, "")
    with pytest.raises(UndecidedError, match="magic"):
        normal_forms(broken)


DOUBLES = st.floats(-8, 8, allow_nan=False, width=32).map(ca.SX)
UNITS = st.sampled_from([-1.0, 1.0]).map(ca.SX)
"""Constants that CasADi folds without rounding."""


def trees(constants: st.SearchStrategy[ca.SX] = DOUBLES) -> st.SearchStrategy[ca.SX]:
    leaves = st.sampled_from([x, y, z]) | constants
    pairs = [ca.plus, ca.minus, ca.times]
    return st.recursive(
        leaves,
        lambda node: (
            st.builds(lambda op, a, b: op(a, b), st.sampled_from(pairs), node, node)
            | node.map(lambda a: -a)
            | node.map(lambda a: a**2)
        ),
        max_leaves=12,
    )


rationals = st.fractions(-5, 5, max_denominator=7)


def exact_value(graph: ClaimGraph, point: dict[str, Fraction]) -> Fraction:
    """Straightforward evaluation with Fractions: the oracle."""
    values: list[Fraction] = []
    operations = {
        "add": lambda a, b: a + b,
        "sub": lambda a, b: a - b,
        "mul": lambda a, b: a * b,
        "neg": lambda a: -a,
        "sq": lambda a: a * a,
        "twice": lambda a: 2 * a,
    }
    for step in graph.steps:
        if step.op == "output":
            return values[step.args[0]]
        if step.op == "input":
            values.append(point[graph.inputs[step.slot[0]].name])
        elif step.op == "const":
            values.append(Fraction(step.const))
        else:
            values.append(operations[step.op](*(values[a] for a in step.args)))
    return Fraction(0)


@settings(max_examples=60)
@given(trees(), rationals, rationals, rationals)
def test_normal_forms_keep_the_value(tree, a, b, c):
    graph = graph_of(tree)
    forms = normal_forms(graph)
    point = {"x": a, "y": b, "z": c}
    total = Fraction(0)
    for polynomial in forms.results.values():
        for exponents, coefficient in () if polynomial == 0 else polynomial.terms():
            term = Fraction(int(coefficient.p), int(coefficient.q))
            for generator, power in enumerate(exponents):
                if power:
                    name = graph.inputs[forms.variables[generator][0]].name
                    term *= point[name] ** int(power)
            total += term
    assert total == exact_value(graph, point)


@settings(max_examples=40)
@given(trees(UNITS), trees(UNITS), trees(UNITS))
def test_distributive_law_on_random_trees(a, b, c):
    assert vanishes((a + ca.sin(x * b)) * c - (a * c + ca.sin(b * x) * c))
