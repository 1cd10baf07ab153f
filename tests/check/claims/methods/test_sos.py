"""Identities written by hand: which are accepted, and which are not."""

from __future__ import annotations

import copy
from fractions import Fraction

import casadi as ca
import pytest

from rrnn_opt.check.claims.certificate import check_certificate
from rrnn_opt.claim import Claim, Hypothesis, Range, Relation
from rrnn_opt.errors import DocumentError
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification.document import certificate_document

X = Symbol.scalar("x")
x = X.sx
UNIT = (Range("x", (Fraction(0),), (Fraction(1),)),)
ONE = [["1", []]]
THIS = [["1", [[0, 1]]]]
POINT = {"x": (Fraction(1, 2),)}


def square(gram, basis, factors=()):
    return {"factors": list(factors), "basis": basis, "gram": gram}


def proof(*squares, margin="0", multipliers=()):
    return {"margin": margin, "squares": list(squares), "multipliers": [*multipliers]}


def check(expression, sense, *proofs, domain=()):
    stated = Claim("T", "", "", (X,), Relation(expression, sense), domain=domain)
    payload = {"elements": list(proofs)}
    document = certificate_document(stated, "sos", payload=payload, witness=POINT)
    return check_certificate(document)


def test_a_product_of_what_is_given():
    both = proof(square([["1"]], [ONE], (0, 1)))  # x >= 0 and 1 - x >= 0
    assert check(x * (1 - x), ">=0", both, domain=UNIT).status == "PROVED"
    assert check(x * (x - 1), "<=0", both, domain=UNIT).status == "PROVED"
    twice = proof(square([["2"]], [ONE], (0, 1)))
    assert check(x * (1 - x), ">=0", twice, domain=UNIT).status == "UNKNOWN"
    assert check(2 * x * (1 - x), ">0", twice, domain=UNIT).status == "UNKNOWN"


def test_a_gram_matrix():
    gram = [["1", "-1/2"], ["-1/2", "1"]]
    expression = x**2 - x + 1
    assert check(expression, ">=0", proof(square(gram, [ONE, THIS]))).trust == "exact"
    strict = proof(square([["1/4", "-1/2"], ["-1/2", "1"]], [ONE, THIS]), margin="3/4")
    assert check(expression, ">0", strict).status == "PROVED"
    flat = [["0", "-1/2"], ["-1/2", "1"]]
    bad = proof(square(flat, [ONE, THIS]), margin="1")
    refused = check(expression, ">0", bad)
    assert refused.status == "UNKNOWN"
    assert "negative eigenvalue" in refused.reason


def test_margins():
    nothing = proof(square([["1"]], [THIS]))
    assert check(x**2, ">=0", nothing).status == "PROVED"
    assert check(x**2, ">0", nothing).status == "UNKNOWN"
    borrowed = proof(square([["1"]], [THIS]), margin="-1")
    assert check(x**2 - 1, ">=0", borrowed).status == "UNKNOWN"


def test_equations_need_no_squares_or_their_own():
    minimum = ca.fmin(x, 1)
    zero = (minimum - x) * (minimum - 1)
    multiplier = {"equality": 0, "polynomial": ONE}
    assert check(zero, "==0", proof(multipliers=[multiplier])).status == "PROVED"
    # p >= 0 does not show p = 0
    assert check(x**2, "==0", proof(square([["1"]], [THIS]))).status == "UNKNOWN"


def test_an_equation_has_no_margin():
    """x = 1/2 + (x - 1/2) is true, and shows x = 1/2, not x = 0."""
    half = Hypothesis("H1", "x is a half", Relation(x - 0.5, "==0"))
    false = Claim("T", "", "", (X,), Relation(x, "==0"), hypotheses=(half,))
    given = proof(margin="1/2", multipliers=[{"equality": 0, "polynomial": ONE}])
    payload = {"elements": [given]}
    document = certificate_document(false, "sos", payload=payload, witness=POINT)
    checked = check_certificate(document)
    assert checked.status == "UNKNOWN"
    assert "margin" in checked.reason


def test_two_cases_of_an_atom():
    larger = ca.fmax(x, -x)  # generator 1

    def half(factors, equality=2):
        term = {"equality": equality, "polynomial": ONE}
        return proof(square([["1/2"]], [ONE], factors), multipliers=[term])

    # t = (t - x) + 2x/2 where 2x >= 0, and t = (t + x) - 2x/2 where -2x >= 0
    both = {"split": 0, "cases": [half([2], 1), half([2], 1)]}
    assert check(larger, ">=0", both).status == "PROVED", check(larger, ">=0", both)
    twice = {"split": 0, "cases": [half([2], 1), half([1], 1)]}
    assert check(larger, ">=0", twice).status == "UNKNOWN"
    for broken in (
        {"split": 1, "cases": both["cases"]},
        {"split": 0, "cases": both["cases"][:1]},
        {"split": 0, "cases": [both, both["cases"][1]] * 9},
    ):
        with pytest.raises(DocumentError):
            check(larger, ">=0", broken)


def test_every_element_needs_its_own():
    one = proof(square([["1"]], [THIS]))
    assert check(ca.vertcat(x**2, x**2), ">=0", one, one).status == "PROVED"
    assert check(ca.vertcat(x**2, x), ">=0", one, one).status == "UNKNOWN"
    with pytest.raises(DocumentError, match="2 elements"):
        check(ca.vertcat(x**2, x**2), ">=0", one)


@pytest.mark.parametrize(
    "change",
    [
        lambda p: p.pop("margin"),
        lambda p: p.update(margin=0.0),
        lambda p: p["squares"][0].update(factors=[2]),
        lambda p: p["squares"][0].update(factors=[-1]),
        lambda p: p["squares"][0].update(basis=[]),
        lambda p: p["squares"][0].update(gram=[["1/0"]]),
        lambda p: p["squares"][0].update(gram=[["nan"]]),
        lambda p: p["squares"][0].update(basis=[[["1", [[99, 1]]]]]),
        lambda p: p["squares"][0].update(basis=[[["1", [[0, -1]]]]]),
        lambda p: p["squares"][0].update(basis=[[["1", [[0, 10**9]]]]]),
        lambda p: p.update(multipliers=[{"equality": 0, "polynomial": ONE}]),
        lambda p: p.update(squares=None),
    ],
)
def test_unreadable_payloads_are_refused(change):
    both = proof(square([["1"]], [ONE], (0, 1)))
    broken = copy.deepcopy(both)
    change(broken)
    with pytest.raises(DocumentError):
        check(x * (1 - x), ">=0", broken, domain=UNIT)
