"""Certificates that were tampered with, forged, or cannot be read."""

from __future__ import annotations

import base64
import copy
import hashlib
import zlib
from fractions import Fraction

import casadi as ca
import pytest

from rrnn_opt.check.claims.certificate import (
    check_certificate,
)
from rrnn_opt.check.claims.document import read_claim
from rrnn_opt.claim import Hypothesis, Range, Relation
from rrnn_opt.errors import DocumentError
from rrnn_opt.verification.document import certificate_document, claim_block
from tests.check.claims.stated import IDENTITY, NONNEGATIVE, POINT, X, Y, claim, x, y


def test_the_checker_computes_the_claims_own_fingerprint():
    stated = claim(
        IDENTITY * ca.fmax(x, 0.1),
        "<=0",
        hypotheses=(Hypothesis("A1", "", Relation(y, ">=0")),),
        domain=(NONNEGATIVE, Range("y", (None, Fraction(-1, 3)), (Fraction(5), None))),
        order="discrete",
        jacobian="frozen",
    )
    assert read_claim(claim_block(stated)).fingerprint == stated.fingerprint


def corrupted(document):
    """Every single change of an operation, operand or constant, and more."""
    for k, (op, _, args, const, _) in enumerate(document["claim"]["tape"]):
        changes = []
        if const is not None:
            changes.append((3, (float.fromhex(const) + 2.0**-40).hex()))
        if op in ("add", "sub", "mul"):
            changes.append((0, {"add": "sub", "sub": "mul", "mul": "add"}[op]))
            changes.append((2, [args[0], args[0]]))
        for place, value in changes:
            broken = copy.deepcopy(document)
            broken["claim"]["tape"][k][place] = value
            yield broken
    for key, value in (("senses", [">=0"]), ("order", "discrete"), ("tape", [])):
        yield copy.deepcopy(document) | {"claim": document["claim"] | {key: value}}


def test_a_corrupted_certificate_never_holds():
    document = certificate_document(claim(IDENTITY + 0.1 * x - x * 0.1), "identity")
    assert check_certificate(document).holds
    broken = list(corrupted(document))
    assert len(broken) > 10
    for variant in broken:
        assert check_certificate(variant).status == "UNKNOWN"


def test_a_forger_who_renews_the_fingerprint_proves_another_claim():
    document = certificate_document(claim(IDENTITY), "identity")
    fingerprint = document["claim"]["fingerprint"]
    for variant in corrupted(document):
        variant["claim"]["fingerprint"] = read_claim(variant["claim"]).fingerprint
        assert check_certificate(variant).fingerprint != fingerprint


def test_a_document_that_says_too_much_does_not_hold():
    document = certificate_document(claim(x), "identity") | {"status": "PROVED"}
    assert not check_certificate(document).holds
    refuted = certificate_document(claim(x), "replay", witness=POINT)
    assert check_certificate(refuted).holds
    assert not check_certificate(refuted | {"status": "PROVED"}).holds
    assert not check_certificate(refuted | {"trust": "arb"}).holds
    assert not check_certificate(refuted | {"assumptions": ["A1"]}).holds


@pytest.mark.parametrize(
    "change",
    [
        lambda d: d.pop("claim"),
        lambda d: d.update(kind="plan"),
        lambda d: d.update(method="trust me"),
        lambda d: d["claim"].pop("tape"),
        lambda d: d["claim"].update(tape=[["add", 0, [0, 1], None, None]]),
        lambda d: d["claim"].update(tape=[["input", 0, [], None, [7, 0]]]),
        lambda d: d["claim"].update(tape=[["const", 0, [], "nonsense", None]]),
        lambda d: d["claim"].update(inputs=[["x", [10**9, 1]]]),
        lambda d: d["claim"].update(senses=[]),
        lambda d: d["claim"].update(senses=["!=0"]),
        lambda d: d["claim"].update(
            domain=[{"variable": "u", "lower": [], "upper": []}]
        ),
        lambda d: d["claim"].update(
            domain=[{"variable": "x", "lower": ["1"], "upper": ["0"]}]
        ),
        lambda d: d.update(method="replay", witness=None),
        lambda d: d.update(
            method="replay", witness={"x": ["1e999999999"], "y": ["0", "0"]}
        ),
        lambda d: d.update(method="replay", witness={"x": ["1/0"], "y": ["0", "0"]}),
        lambda d: d.update(method="replay", witness={"x": ["1"], "y": ["0"]}),
        lambda d: d.update(note=float("nan")),
    ],
)
def test_an_unreadable_document_is_refused(change):
    document = certificate_document(claim(IDENTITY), "identity")
    change(document)
    with pytest.raises(DocumentError):
        check_certificate(document)


@pytest.mark.parametrize("method", ["interval", "terms", "smt", "sos", "identity"])
def test_an_operation_with_too_few_operands_proves_nothing(method):
    bounded = tuple(
        Range(s.name, (Fraction(0),) * s.size, (Fraction(1),) * s.size) for s in (X, Y)
    )
    stated = claim(x * y[0], ">=0", domain=bounded)
    document = certificate_document(stated, method)
    for row in document["claim"]["tape"]:
        row[2] = row[2][:1] if row[0] == "mul" else row[2]
    document["claim"]["fingerprint"] = read_claim(document["claim"]).fingerprint
    leaf = {"nodes": 1, "sha256": hashlib.sha256(b"\xff").hexdigest()}
    leaf["tree"] = base64.b64encode(zlib.compress(b"\xff")).decode()
    document["payload"] = {"solvers": ["z3"], "elements": []} | leaf
    checked = check_certificate(document)
    assert checked.status == "UNKNOWN"
    assert "operation 'mul'" in checked.reason


@pytest.mark.parametrize("slot", [[], [0], [0, 0, 0], 0, "ab", ["a", "b"], {"0": 1}])
def test_a_slot_is_a_port_and_an_element(slot):
    document = copy.deepcopy(certificate_document(claim(IDENTITY), "identity"))
    tape = document["claim"]["tape"]
    tape[0][-1] = slot
    with pytest.raises(DocumentError):
        check_certificate(document)
