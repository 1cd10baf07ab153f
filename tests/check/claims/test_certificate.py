"""The judge: what it accepts, what it refuses, and that nobody else can judge."""

from __future__ import annotations

import copy
import pickle
from dataclasses import replace
from fractions import Fraction

import casadi as ca
import pytest

from rrnn_opt.check.claims.certificate import (
    CheckedCertificate,
    check_certificate,
    versions,
)
from rrnn_opt.claim import Hypothesis, Range, Relation
from rrnn_opt.errors import RrnnError
from rrnn_opt.verification.document import certificate_document
from tests.check.claims.stated import IDENTITY, NONNEGATIVE, POINT, check, claim, x, y


def test_an_identity_is_proved_exactly():
    checked = check(IDENTITY)
    assert (checked.status, checked.trust, checked.holds) == ("PROVED", "exact", True)
    assert checked.certificate["versions"] == versions()
    assert check_certificate(checked.certificate).holds
    assert checked.to_dict()["witness"] is None


def test_a_vector_goal_needs_every_element():
    assert check(ca.vertcat(IDENTITY, IDENTITY)).status == "PROVED"
    assert check(ca.vertcat(IDENTITY, x)).status == "UNKNOWN"


def test_an_identity_proves_no_strict_inequality():
    assert check(IDENTITY, ">=0").status == "PROVED"
    assert check(IDENTITY, ">0").status == "UNKNOWN"


def test_where_operations_may_be_undefined_that_is_an_assumption():
    quotient = (x + y[0]) / y[1] - x / y[1] - y[0] / y[1]
    checked = check(quotient, witness=POINT)
    assert checked.status == "HOLDS_UNDER"
    assert checked.assumptions == ("D1: every operation of the graph is defined (inv)",)
    assert check(quotient).status == "UNKNOWN"  # perhaps it never is
    assert check(quotient, witness=POINT | {"y": (0, 0)}).status == "UNKNOWN"


def test_a_proof_is_of_something():
    positive = Hypothesis("A1", "", Relation(x, ">0"))
    negative = Hypothesis("A2", "", Relation(-x, ">=0"))

    def status(*hypotheses, witness=POINT, **more):
        return check(IDENTITY, hypotheses=hypotheses, witness=witness, **more).status

    assert status(positive) == "PROVED"
    assert status(positive, witness=None) == "UNKNOWN"
    assert status(negative) == "UNKNOWN"
    assert status(positive, negative) == "UNKNOWN"
    outside = Range("x", (Fraction(2),), (Fraction(3),))
    assert status(domain=(outside,)) == "UNKNOWN"
    assert status(witness=None) == "PROVED"


@pytest.mark.parametrize(
    ("expression", "sense", "domain", "status"),
    [
        (x**2 + 2 * y[0] ** 4, ">=0", (), "PROVED"),
        (x**2 + 1, ">0", (), "PROVED"),
        (x**2, ">0", (), "UNKNOWN"),
        (x**3, ">=0", (), "UNKNOWN"),
        (x**3, ">=0", (NONNEGATIVE,), "PROVED"),
        (-(x**3) - y[0] ** 2, "<=0", (NONNEGATIVE,), "PROVED"),
        (-x, ">=0", (Range("x", (None,), (Fraction(0),)),), "PROVED"),
        (x - y[0], ">=0", (NONNEGATIVE,), "UNKNOWN"),
        (x, "==0", (NONNEGATIVE,), "UNKNOWN"),
        (ca.vertcat(x, -1), ">=0", (NONNEGATIVE,), "UNKNOWN"),
    ],
)
def test_signs_of_terms(expression, sense, domain, status):
    assert check(expression, sense, method="terms", domain=domain).status == status


def test_a_witness_refutes():
    checked = check(x - ca.sin(y[0]), "<=0", method="replay", witness=POINT)
    assert (checked.status, checked.trust) == ("REFUTED", "arb")
    assert checked.witness == {"x": ["1"], "y": ["1/3", "-2"]}
    exact = check(x - 3 * y[0] + 1, "==0", method="replay", witness=POINT)
    assert (exact.status, exact.trust) == ("REFUTED", "exact")


@pytest.mark.parametrize(
    ("expression", "sense", "refuted"),
    [
        (x - 3 * y[0], "==0", False),
        (x - 3 * y[0], ">=0", False),
        (x - 3 * y[0], ">0", True),
        (x - 3 * y[0], "<0", True),
        (y[1], ">=0", True),
        (y[1], "<0", False),
        (ca.vertcat(x, y[1]), ">0", True),
    ],
)
def test_which_signs_break_which_sense(expression, sense, refuted):
    checked = check(expression, sense, method="replay", witness=POINT)
    assert checked.status == ("REFUTED" if refuted else "UNKNOWN")


def test_a_witness_must_keep_domain_and_hypotheses():
    def status(**more):
        return check(y[1], ">=0", method="replay", witness=POINT, **more).status

    kept = Hypothesis("A1", "", Relation(x, ">0"))
    broken = Hypothesis("A2", "", Relation(y[0] - x, ">=0"))
    worded = Hypothesis("A3", "the noise is independent")
    outside = Range("x", (Fraction(2),), (Fraction(3),))
    assert status(hypotheses=(kept,), domain=(NONNEGATIVE,)) == "REFUTED"
    assert status(hypotheses=(kept, broken)) == "UNKNOWN"
    assert status(hypotheses=(worded,)) == "UNKNOWN"
    assert status(domain=(outside,)) == "UNKNOWN"


def test_only_the_checker_makes_a_verdict():
    with pytest.raises(RrnnError, match="only check_certificate"):
        CheckedCertificate("PROVED", "I say so", "{}", "exact")
    checked = check(x)
    with pytest.raises((RrnnError, ValueError)):
        replace(checked, status="PROVED")
    with pytest.raises(RrnnError, match="document"):
        pickle.dumps(checked)
    with pytest.raises(RrnnError, match="document"):
        copy.copy(checked)
    checked.document["status"] = "PROVED"
    assert checked.certificate["status"] == "UNKNOWN"


def test_what_the_source_does_not_state_is_an_assumption():
    added = Hypothesis("A1", "x is not negative", Relation(x, ">=0"), added=True)
    checked = check(IDENTITY, hypotheses=(added,), witness=POINT)
    assert checked.status == "HOLDS_UNDER"
    assert checked.assumptions == ("A1: x is not negative",)
    unaltered = claim(IDENTITY, hypotheses=(added,))
    stated = certificate_document(unaltered, "identity", witness=POINT)
    stated["claim"]["hypotheses"][0][3] = False
    assert check_certificate(stated).status == "UNKNOWN"  # another claim


def test_what_is_assumed_cannot_be_reworded():
    rank = Hypothesis("A1", "J has full rank", Relation(x, ">0"), added=True)
    document = certificate_document(
        claim(IDENTITY, hypotheses=(rank,)), "identity", witness=POINT
    )
    assert check_certificate(document).assumptions == ("A1: J has full rank",)
    document["claim"]["hypotheses"][0][1] = "nothing much"
    checked = check_certificate(document)
    assert (checked.status, checked.holds) == ("UNKNOWN", False)
