"""Every operation of the tape through every interpreter that there is.

numpy, C, the exact replay, intervals, and both translations to SMT must agree on
what an operation means wherever they know it; here is also written down which ones
they do not know.
"""

from __future__ import annotations

from fractions import Fraction

import casadi as ca
import numpy as np
import pytest
import z3

from rrnn_opt import emit
from rrnn_opt.check.claims.document import read_claim
from rrnn_opt.check.claims.graph.point import replay
from rrnn_opt.check.claims.methods.smt import Script
from rrnn_opt.claim import Claim, Hypothesis, Range, Relation
from rrnn_opt.errors import UndecidedError, UnsupportedOperationError
from rrnn_opt.symbolic import Symbol
from rrnn_opt.symbolic.interpreter import evaluate
from rrnn_opt.symbolic.tape import OPERATIONS, Tape
from rrnn_opt.verification.document import claim_block
from rrnn_opt.verification.engines.interval.kernel import IntervalKernel
from rrnn_opt.verification.engines.smt.text import smt_text

A, B, R = Symbol.scalar("a"), Symbol.scalar("b"), Symbol.scalar("r")
a, b = A.sx, B.sx
POINTS = [(0.25, -0.5), (-1.5, 2.0), (2.0, 2.0), (0.0, 0.75), (0.5, 3.0)]
BUILD = {
    "sub": a - b, "add": a + b, "mul": a * b, "div": a / b, "neg": -a, "sq": a * a,
    "twice": 2 * a, "inv": 1 / a, "lt": a < b, "le": a <= b, "eq": a == b,
    "ne": a != b, "not": ca.logic_not(a), "and": ca.logic_and(a, b),
    "or": ca.logic_or(a, b), "pow": a**b, "if_else_zero": ca.if_else(a, b, 0),
}  # fmt: skip
COMPUTED = [r for r in OPERATIONS if r not in ("input", "output", "const")]
TRANSCENDENTAL = {
    "exp", "expm1", "log", "log1p", "tan", "asin", "acos", "atan", "atan2", "sinh",
    "cosh", "tanh", "hypot",
}  # fmt: skip
UNKNOWN_TO_INTERVALS = TRANSCENDENTAL | {"floor", "ceil", "copysign", "pow"}
UNKNOWN_TO_SMT = TRANSCENDENTAL | {"copysign", "pow"}


def expression(name):
    arguments = (a, b)[: OPERATIONS[name].arity]
    return BUILD[name] if name in BUILD else getattr(ca, name)(*arguments)


def function(name):
    return ca.Function(name + "_", [a, b], [expression(name)], ["a", "b"], ["y"])


def true_value(name, point):
    """(lower, upper) of the value; equal where it is rational; None: undefined."""
    stated = Claim("T", "", "", (A, B), Relation(expression(name), ">=0"))
    slots = {(k, 0): Fraction(x) for k, x in enumerate(point)}
    graph = read_claim(claim_block(stated))
    try:
        seen = replay(graph, slots, skip=0)
    except UndecidedError:
        return None
    ((text,),) = seen.values
    if seen.trust == "exact":
        return Fraction(text), Fraction(text)
    middle = Fraction(float(text.strip("[]").split(" +/- ")[0]))
    return middle - Fraction(1, 10**9), middle + Fraction(1, 10**9)


@pytest.fixture(scope="module")
def program():
    return emit.compile([function(name) for name in COMPUTED], name="every_operation")


@pytest.mark.parametrize("name", COMPUTED)
def test_numpy_and_c_agree_with_the_exact_value(name, program):
    defined = 0
    for point in POINTS:
        value = true_value(name, point)
        columns = [np.array([x]) for x in point]
        ours = float(evaluate(Tape.of(function(name)), columns)[0][0, 0])
        (compiled,) = program.call(name + "_", *columns)
        assert float(compiled.item()) == pytest.approx(ours, rel=1e-14, nan_ok=True)
        if value is not None:
            defined += 1
            assert ours == pytest.approx(float(sum(value)) / 2, rel=2e-9, abs=2e-9)
    assert defined >= 2


KNOWN_TO_INTERVALS = [n for n in COMPUTED if n not in UNKNOWN_TO_INTERVALS]
PARTIAL = ("div", "inv", "sqrt")


@pytest.mark.parametrize("name", sorted(UNKNOWN_TO_INTERVALS))
def test_intervals_say_what_they_cannot_do(name):
    with pytest.raises(UnsupportedOperationError):
        IntervalKernel.of(function(name))


@pytest.mark.parametrize(
    "names",
    [
        tuple(n for n in KNOWN_TO_INTERVALS if n not in PARTIAL),
        *((n,) for n in PARTIAL),
    ],
    ids=len,
)
def test_intervals_contain_the_exact_value(names):
    rows = [expression(name) for name in names]
    kernel = IntervalKernel.of(ca.Function("rows", [a, b], [ca.vertcat(*rows)]))
    columns = np.array(POINTS).T
    for radius in (0.0, 0.125):
        found = kernel(columns - radius, columns + radius)
        assert found.bounded.sum() >= 2
        for k in np.flatnonzero(found.bounded):
            for row, name in enumerate(names):
                value = true_value(name, POINTS[k])
                assert value is not None
                assert float(found.lower[row, k]) <= value[1]
                assert value[0] <= float(found.upper[row, k])


def finder(stated):
    query = smt_text(stated)
    return query.common, query.negations


def checker(stated):
    text = Script(read_claim(claim_block(stated)))
    return text.lines, text.broken


def satisfiable(lines, formula):
    solver = z3.Solver()
    solver.from_string("\n".join([*lines, f"(assert {formula})"]))
    answer = solver.check()
    assert answer in (z3.sat, z3.unsat)
    return answer == z3.sat


def stated_at(name, point, value, *, hypothesis):
    """At the point, the operation's result equals r, which lies around the value."""
    ranges = [
        Range(n, (Fraction(x),), (Fraction(x),))
        for n, x in zip("ab", point, strict=True)
    ]
    ranges.append(Range("r", (value[0],), (value[1],)))
    equal = Relation(expression(name) - R.sx, "==0")
    given = (Hypothesis("A1", "", equal),) if hypothesis else ()
    goal = Relation(R.sx, ">0") if hypothesis else equal
    return Claim("T", "", "", (A, B, R), goal, hypotheses=given, domain=tuple(ranges))


@pytest.mark.parametrize("translation", [finder, checker])
@pytest.mark.parametrize("name", COMPUTED)
def test_smt_allows_the_exact_value_and_nothing_else(name, translation):
    if name in UNKNOWN_TO_SMT:
        with pytest.raises(UndecidedError):
            translation(stated_at(name, POINTS[0], (0, 1), hypothesis=True))
        return
    for point in POINTS:
        value = true_value(name, point)
        if value is None:
            continue
        lines, _ = translation(stated_at(name, point, value, hypothesis=True))
        assert satisfiable(lines, "true")
        if value[0] == value[1] and name not in ("sin", "cos"):
            lines, broken = translation(stated_at(name, point, value, hypothesis=False))
            assert not any(satisfiable(lines, formula) for formula in broken)
