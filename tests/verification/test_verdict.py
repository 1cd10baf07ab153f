"""Verdicts rest on the checker; evidence never becomes one."""

from __future__ import annotations

import dataclasses

import pytest

from rrnn_opt.check.claims.certificate import check_certificate
from rrnn_opt.claim import Claim, Relation
from rrnn_opt.errors import RrnnError
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import Evidence, Status, Verdict
from rrnn_opt.verification.document import certificate_document

X = Symbol.scalar("x")


def claim(expression):
    return Claim("T", "", "", (X,), Relation(expression, "==0"))


def checked(stated):
    return check_certificate(certificate_document(stated, "identity"))


TRUE, FALSE = claim((X.sx + 1) ** 2 - X.sx**2 - 2 * X.sx - 1), claim(X.sx)


def test_a_checked_certificate_makes_a_verdict():
    verdict = Verdict(TRUE.fingerprint, "identity", checked(TRUE))
    assert verdict.status is Status.PROVED
    assert verdict.trust == "exact"
    assert check_certificate(verdict.certificate).status == "PROVED"
    assert verdict.witness is None
    assert verdict.assumptions == ()


def test_without_a_certificate_nothing_is_known():
    verdict = Verdict(TRUE.fingerprint, residue=("identity: too large",))
    assert verdict.status is Status.UNKNOWN
    assert verdict.reason == "identity: too large"
    assert (verdict.certificate, verdict.trust) == (None, None)


@dataclasses.dataclass
class Pretender:
    status: str = "PROVED"
    holds: bool = True
    fingerprint: str = TRUE.fingerprint


@pytest.mark.parametrize(
    ("fingerprint", "certificate"),
    [
        (TRUE.fingerprint, Pretender()),
        (TRUE.fingerprint, {"status": "PROVED"}),
        (TRUE.fingerprint, Evidence("T", "sampled", 10**6, (0.0, 0.0), 0)),
        (FALSE.fingerprint, checked(FALSE)),  # unknown settles nothing
        (FALSE.fingerprint, checked(TRUE)),  # the proof of another claim
    ],
)
def test_nothing_else_does(fingerprint, certificate):
    with pytest.raises(RrnnError, match="verdict"):
        Verdict(fingerprint, "identity", certificate)


def test_a_status_cannot_be_written():
    verdict = Verdict(FALSE.fingerprint)
    with pytest.raises(AttributeError):
        verdict.status = Status.PROVED
    with pytest.raises(TypeError):
        Verdict(FALSE.fingerprint, status=Status.PROVED)


def test_evidence_has_no_way_to_a_verdict():
    evidence = Evidence("C35", "sampled", 100, (0.0, 0.1), 3)
    assert not isinstance(evidence, Verdict)
    assert not any("verdict" in name or "status" in name for name in dir(evidence))
    assert evidence.to_dict() == {
        "claim": "C35", "kind": "sampled", "n": 100, "interval": [0.0, 0.1], "seed": 3,
    }  # fmt: skip
