"""Expanded values beside exact rational evaluation, operation by operation.

Sines and cosines are taken where both are rational: (2t, 1 - t^2) / (1 + t^2).
"""

from __future__ import annotations

from fractions import Fraction

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.check.claims.document import ClaimGraph, Step
from rrnn_opt.check.claims.graph.expansion import (
    MAX_EXPONENT,
    PARTIAL,
    Expansion,
    may_be_undefined,
)
from rrnn_opt.errors import UndecidedError

LEAVES = 3
UNARY = ("neg", "sq", "twice", "inv", "fabs")
BINARY = ("add", "sub", "mul", "div", "fmin", "fmax")
EXACT = {
    "neg": lambda a: -a,
    "sq": lambda a: a * a,
    "twice": lambda a: 2 * a,
    "inv": lambda a: 1 / a,
    "fabs": abs,
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "div": lambda a, b: a / b,
    "fmin": min,
    "fmax": max,
    "pow": lambda a, b: a ** int(b),
}


def expanded(steps, work=100_000):
    """The expansion of some steps, after all of them."""
    graph = ClaimGraph((), (), tuple(steps), (), (), (), {}, "")
    expansion = Expansion(graph, work)
    for step in steps:
        expansion.values[step.out] = expansion.value(step)
    return expansion


def leaves(*constants):
    """Steps for LEAVES inputs, then for constants."""
    inputs = [Step("input", k, (), None, (0, k)) for k in range(LEAVES)]
    rest = [Step("const", LEAVES + k, (), c, None) for k, c in enumerate(constants)]
    return inputs + rest


def grown(rows, *constants):
    """Leaves, then operations on what stands before them."""
    steps = leaves(*constants)
    for op, *picks in rows:
        args = tuple(pick % len(steps) for pick in picks)
        steps.append(Step(op, len(steps), args, None, None))
    return steps


def worth(polynomial, at):
    """Value of a polynomial with the generators' values, 0 if it is the int 0."""
    total = Fraction(0)
    for exponents, coefficient in () if polynomial == 0 else polynomial.terms():
        term = Fraction(int(coefficient.p), int(coefficient.q))
        for generator, power in enumerate(exponents):
            term *= at[generator] ** int(power) if power else 1
        total += term
    return total


def generators(expansion, point, tangents):
    """Values of all generators in use: inputs, circles, then atoms as they came."""
    at = {index: point[slot[1]] for index, slot in expansion.variables.items()}

    def number(generator):
        ((exponents, _),) = generator.terms()
        return exponents.index(1)

    for angle, sine, cosine in expansion.angles:
        t = tangents[expansion.variables[number(angle)][1]]
        at[number(sine)] = 2 * t / (1 + t * t)
        at[number(cosine)] = (1 - t * t) / (1 + t * t)
    for op, operands, atom in expansion.atoms:
        at[number(atom)] = EXACT[op](*(worth(p, at) for p in operands))
    return at


picks = st.integers(0, 40)
rows = st.lists(
    st.tuples(st.sampled_from(UNARY), picks)
    | st.tuples(st.sampled_from(BINARY), picks, picks)
    | st.tuples(st.sampled_from(("sin", "cos")), st.integers(0, LEAVES - 1)),
    min_size=1,
    max_size=8,
)
rationals = st.fractions(-4, 4, max_denominator=5)
triples = st.tuples(rationals, rationals, rationals)


@settings(max_examples=80)
@given(rows, triples, triples)
def test_every_value_is_that_of_the_operations_themselves(rows, point, tangents):
    steps = grown(rows, 0.5, -3.0)
    try:
        expansion = expanded(steps)
        at = generators(expansion, point, tangents)
        exact = []
        for step in steps:
            args = [exact[a] for a in step.args]
            if step.op in ("sin", "cos"):
                t = tangents[step.args[0]]
                side = 2 * t if step.op == "sin" else 1 - t * t
                exact.append(side / (1 + t * t))
            elif step.op == "input":
                exact.append(point[step.slot[1]])
            elif step.op == "const":
                exact.append(Fraction(step.const))
            else:
                exact.append(EXACT[step.op](*args))
    except (ZeroDivisionError, UndecidedError):
        return  # undefined there; the tests below speak of that
    for step, value in zip(steps, exact, strict=True):
        assert worth(expansion.values[step.out], at) == value


@pytest.mark.parametrize("op", ["sin", "cos"])
def test_an_angle_turned_round_is_the_same_circle(op):
    """sin(-a) = -sin(a), cos(-a) = cos(a), and one circle for both."""
    expansion = expanded(grown([("neg", 0), (op, 0), (op, LEAVES)]))
    straight, turned = expansion.values[LEAVES + 1], expansion.values[LEAVES + 2]
    assert turned == (straight if op == "cos" else -straight)
    assert len(expansion.angles) == len(expansion.circles) == 1


def test_the_angle_zero_has_its_values():
    zero = grown([("sub", 0, 0), ("sin", LEAVES), ("cos", LEAVES)])
    expansion = expanded(zero)
    assert expansion.values[LEAVES + 1] == 0
    assert expansion.values[LEAVES + 2] == 1
    assert not expansion.angles


@pytest.mark.parametrize("n", [0, 1, 2, 5, MAX_EXPONENT])
def test_small_whole_powers_are_products(n):
    expansion = expanded(grown([("pow", 0, LEAVES)], float(n)))
    product = expansion.ring.constant(1)
    for _ in range(n):
        product = product * expansion.values[0]
    assert expansion.values[LEAVES + 1] == product
    assert not expansion.atoms


@pytest.mark.parametrize("n", [-1.0, 0.5, MAX_EXPONENT + 1.0])
def test_other_powers_are_atoms_that_may_be_undefined(n):
    expansion = expanded(grown([("pow", 0, LEAVES)], n))
    assert [op for op, _, _ in expansion.atoms] == ["pow"]
    assert expansion.partial == {"pow"}
    assert may_be_undefined("pow")


def test_the_larger_and_smaller_of_two_that_differ_by_a_constant():
    steps = grown(
        [("add", 0, LEAVES), ("fmin", 0, LEAVES + 1), ("fmax", LEAVES + 1, 0)], 2.0
    )
    expansion = expanded(steps)
    assert expansion.values[LEAVES + 2] == expansion.values[0]
    assert expansion.values[LEAVES + 3] == expansion.values[0] + 2
    assert not expansion.atoms


@pytest.mark.parametrize(
    ("op", "same"),
    [("fmin", True), ("hypot", True), ("lt", False), ("atan2", False), ("le", False)],
)
def test_operands_change_places_only_where_the_operation_lets_them(op, same):
    expansion = expanded(grown([(op, 0, 1), (op, 1, 0), (op, 0, 1)]))
    first, swapped, again = (expansion.values[LEAVES + k] for k in range(3))
    assert first == again
    assert (first == swapped) is same


@pytest.mark.parametrize("op", sorted(PARTIAL))
def test_what_may_be_undefined_is_named(op):
    """Also where the value is multiplied by zero afterwards."""
    count = PARTIAL[op]
    rows = [(op, *range(count)), ("sub", 0, 0), ("mul", LEAVES, LEAVES + 1)]
    expansion = expanded(grown(rows))
    assert expansion.values[LEAVES + 2] == 0
    assert expansion.partial == {"inv" if op == "div" else op}


def test_a_quotient_by_a_number_is_exact_and_by_zero_is_refused():
    expansion = expanded(grown([("div", 0, LEAVES)], 3.0))
    assert expansion.values[LEAVES + 1] * 3 == expansion.values[0]
    assert expansion.values[LEAVES + 1].leading_coefficient() == fmpq(1, 3)
    with pytest.raises(UndecidedError, match="divides by zero"):
        expanded(grown([("div", 0, LEAVES)], 0.0))


@pytest.mark.parametrize("wrong", [("add", 0), ("neg", 0, 1), ("magic", 0)])
def test_operations_of_another_arity_or_name_are_refused(wrong):
    with pytest.raises(UndecidedError, match="not known"):
        expanded(grown([wrong]))


def test_products_are_paid_for():
    """(x + y)(x + y) costs two terms times two, and not one more."""
    square = grown([("add", 0, 1), ("sq", LEAVES)])
    assert expanded(square, work=4).budget == 0
    with pytest.raises(UndecidedError, match="budget"):
        expanded(square, work=3)
