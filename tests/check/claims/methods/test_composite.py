"""Combinations of lemmas, written by hand: no lemma is used where it says nothing.

An operation that may be undefined is assumed to be defined, but only those of the
claim itself: 1/x in a lemma, or in a factor, proves nothing of x = 0.
"""

from __future__ import annotations

import contextlib
from fractions import Fraction

import casadi as ca
import pytest

from rrnn_opt.check.claims.certificate import check_certificate
from rrnn_opt.claim import Claim, Hypothesis, Range, Relation
from rrnn_opt.errors import DocumentError
from rrnn_opt.symbolic import Symbol
from rrnn_opt.symbolic.tape import Tape
from rrnn_opt.verification.document import certificate_document, port_row, step_row

pytest.importorskip("z3", reason="pip install z3-solver")

X = Symbol.scalar("x")
x = X.sx
UNIT = Range("x", (Fraction(0),), (Fraction(1),))
ZERO = Hypothesis("H", "x = 0", Relation(x, "==0"))
AT_HALF, ZEROS = {"x": (Fraction(1, 2),)}, {"x": (0,)}


def claim(expression, *, hypotheses=(), domain=()):
    return Claim("T", "", "", (X,), Relation(expression, "==0"), hypotheses, domain)


def pieces(*expressions):
    names = [f"r{k}" for k in range(len(expressions))]
    function = ca.Function("p", [x], [ca.SX(e) for e in expressions], ["x"], names)
    tape = Tape.of(function)
    return {
        "inputs": [port_row(port) for port in tape.inputs],
        "outputs": [port_row(port) for port in tape.outputs],
        "tape": [step_row(step) for step in tape.instructions],
    }


def combined(stated, lemma, expressions, terms, *, at):
    """The verdict of the claim by terms over the one lemma."""
    solvers = {"solvers": ["z3"]}
    part = certificate_document(lemma, "smt", payload=solvers, witness=AT_HALF)
    assert check_certificate(part).status == "HOLDS_UNDER"
    combination = pieces(*expressions) | {"elements": [terms]}
    payload = {"parts": [part], "rules": [], "combination": combination}
    document = certificate_document(stated, "composite", payload=payload, witness=at)
    return check_certificate(document)


NOT_ZERO = claim(ca.vertcat(x == 0, ca.if_else(x > 2, 1 / x, 0)), domain=(UNIT,))
"""Where 1/x is defined, x is not 0; its second element is 0 for that."""
USE = {"use": "lemma", "part": 0, "element": 0, "arguments": [0], "factor": 1}


def test_a_lemma_says_nothing_where_its_operations_are_undefined():
    false = claim(ca.SX(x == 0), domain=(UNIT,))  # x = 0 breaks it
    checked = combined(false, NOT_ZERO, (x, 1), [USE], at=AT_HALF)
    assert checked.status == "UNKNOWN"
    assert "may be undefined" in checked.reason


def test_it_may_be_used_where_the_claim_needs_the_same_operations():
    same = claim((x == 0) * (1 / x), domain=(UNIT,))
    checked = combined(same, NOT_ZERO, (x, 1 / x), [USE], at=AT_HALF)
    assert checked.status == "HOLDS_UNDER"
    assert checked.assumptions == ("D1: every operation of the graph is defined (inv)",)


def test_a_factor_says_nothing_where_it_is_undefined():
    """x - 1 = ((x + 1)/x - 1 - 1/x) + (1 - 1/x) x, if only 1/x were defined at 0."""
    lemma, false = claim((x + 1) / x - 1 - 1 / x), claim(x - 1, hypotheses=(ZERO,))
    given = {"use": "hypothesis", "output": 1, "element": 0, "factor": 2}
    checked = combined(false, lemma, (x, 1, 1 - 1 / x), [USE, given], at=ZEROS)
    assert checked.status == "UNKNOWN"
    assert "may be undefined" in checked.reason


def test_a_proof_of_very_many_levels_is_refused():
    square = claim(x * 0)
    document = certificate_document(square, "identity")
    for _ in range(400):
        payload = {"parts": [document], "rules": [], "combination": None}
        document = certificate_document(square, "composite", payload=payload)
    with contextlib.suppress(DocumentError):
        assert check_certificate(document).status == "UNKNOWN"
