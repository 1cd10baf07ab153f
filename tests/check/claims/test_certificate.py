"""The judge: what it accepts, what it refuses, and that nobody else can judge."""

from __future__ import annotations

import base64
import copy
import hashlib
import pickle
import zlib
from dataclasses import replace
from fractions import Fraction

import casadi as ca
import pytest

from rrnn_opt.check.claims.certificate import (
    CheckedCertificate,
    check_certificate,
    versions,
)
from rrnn_opt.check.claims.document import read_claim
from rrnn_opt.claim import Claim, Hypothesis, Range, Relation
from rrnn_opt.errors import DocumentError, RrnnError
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification.document import certificate_document, claim_block

X, Y = Symbol.scalar("x"), Symbol.vector("y", 2)
x, y = X.sx, Y.sx


def claim(expression, sense="==0", **more) -> Claim:
    return Claim("T", "", "", (X, Y), Relation(expression, sense), **more)


def check(expression, sense="==0", *, method="identity", witness=None, **more):
    stated = claim(expression, sense, **more)
    return check_certificate(certificate_document(stated, method, witness=witness))


IDENTITY = (x + y[0]) ** 2 - x**2 - 2 * x * y[0] - y[0] ** 2 + ca.sin(y[1]) * 0.0
NONNEGATIVE = Range("x", (Fraction(0),), (None,))
POINT = {"x": (1,), "y": (Fraction(1, 3), -2)}


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
