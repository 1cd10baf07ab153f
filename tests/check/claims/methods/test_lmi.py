"""Decay of linear systems: the checker alone, on matrices known by hand."""

from __future__ import annotations

from fractions import Fraction

import pytest

from rrnn_opt.check.claims.certificate import check_certificate
from rrnn_opt.check.claims.methods.lmi import read_decay
from rrnn_opt.claim import Hypothesis
from rrnn_opt.decay import DecayClaim, exact_matrix
from rrnn_opt.errors import DocumentError
from rrnn_opt.verification.engines.lmi import decay_document

DAMPED = exact_matrix([[-1, 2], [-2, -1]])  # eigenvalues -1 +- 2i, Q = I
UNIT = [["1", "0"], ["0", "1"]]


def claim(rate, *vertices, **more):
    return DecayClaim("T", "", "", vertices or (DAMPED,), Fraction(rate), **more)


def lmi(stated, q):
    return check_certificate(decay_document(stated, "lmi", payload={"Q": q}))


def spectrum(stated, vertex="0"):
    witness = {"vertex": [vertex]}
    return check_certificate(decay_document(stated, "spectrum", witness=witness))


def test_a_quadratic_function_proves_up_to_the_true_rate():
    checked = lmi(claim(1), UNIT)
    assert (checked.status, checked.trust, checked.holds) == ("PROVED", "exact", True)
    assert lmi(claim("1000001/1000000"), UNIT).status == "UNKNOWN"


def test_an_eigenvalue_refutes_beyond_it():
    checked = spectrum(claim("1000001/1000000"))
    assert (checked.status, checked.trust) == ("REFUTED", "arb")
    assert checked.witness == {"vertex": ["0"]}
    assert spectrum(claim(1)).status == "UNKNOWN"


@pytest.mark.parametrize(
    "q",
    [[["1", "1"], ["0", "1"]], [["0", "0"], ["0", "0"]], [["-1", "0"], ["0", "-1"]]],
)
def test_q_is_symmetric_and_positive(q):
    assert lmi(claim(0), q).status == "UNKNOWN"


def test_every_vertex_counts():
    other = exact_matrix([[-1, 0], [0, "1/10"]])
    assert lmi(claim(0, DAMPED, other), UNIT).status == "UNKNOWN"
    assert spectrum(claim(0, DAMPED, other)).status == "UNKNOWN"
    assert spectrum(claim(0, DAMPED, other), "1").status == "REFUTED"


def test_discrete_time():
    halved = exact_matrix([["1/2", 0], [0, "-1/2"]])
    assert lmi(claim("1/2", halved, discrete=True), UNIT).status == "PROVED"
    assert lmi(claim("49/100", halved, discrete=True), UNIT).status == "UNKNOWN"
    assert spectrum(claim("49/100", halved, discrete=True)).status == "REFUTED"


def test_added_hypotheses_are_assumptions():
    added = Hypothesis("A1", "no bound is active", added=True)
    checked = lmi(claim(1, hypotheses=(added,)), UNIT)
    assert checked.status == "HOLDS_UNDER"
    assert checked.assumptions == ("A1: no bound is active",)


def test_no_vertex_refutes_what_is_claimed_under_hypotheses_in_words():
    """x' = x from x = 0 decays at any rate; words cannot be held against that."""
    zero = Hypothesis("H1", "x(0) = 0")
    grows = exact_matrix([[1]])
    checked = spectrum(claim(1, grows, hypotheses=(zero,)))
    assert checked.status == "UNKNOWN"
    assert "words" in checked.reason


def test_the_checker_computes_the_claims_own_fingerprint():
    stated = claim("1/3", order="first-order", jacobian="frozen")
    block = decay_document(stated, "lmi")["claim"]
    assert read_decay(block).fingerprint == stated.fingerprint
    block["rate"] = "1/2"
    assert read_decay(block).fingerprint != stated.fingerprint


@pytest.mark.parametrize(
    "change",
    [
        lambda d: d["claim"].update(vertices=[]),
        lambda d: d["claim"].update(vertices=[[["1", "2"]]]),
        lambda d: d["claim"].update(vertices=[[["1"]], [["1", "0"], ["0", "1"]]]),
        lambda d: d["claim"].update(rate="-1"),
        lambda d: d["claim"].update(rate=0.5),
        lambda d: d["claim"].update(discrete="no"),
        lambda d: d["claim"].update(form="sentence"),
        lambda d: d.update(method="identity"),
        lambda d: d.update(payload=None),
        lambda d: d.update(payload={"Q": [["1"]]}),
        lambda d: d.update(method="spectrum", witness=None),
        lambda d: d.update(method="spectrum", witness={"vertex": ["7"]}),
    ],
)
def test_unreadable_documents_are_refused(change):
    document = decay_document(claim(1), "lmi", payload={"Q": UNIT})
    change(document)
    with pytest.raises(DocumentError):
        check_certificate(document)
