"""A certificate with one digit, sign, operation or index changed is refused."""

from __future__ import annotations

import functools
from fractions import Fraction

import casadi as ca
import pytest

from rrnn_opt.check.claims.certificate import check_certificate, digest
from rrnn_opt.claim import Claim, Hypothesis, Range, Relation
from rrnn_opt.decay import DecayClaim, exact_matrix
from rrnn_opt.errors import DocumentError
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import certify
from tests.verification.corruption import corruptions

X, Y = Symbol.vector("x", 2), Symbol.vector("y", 2)
x, y = X.sx, Y.sx
BOX = Range("y", (Fraction(-1, 3), Fraction(-2)), (Fraction(1), Fraction(5, 7)))
PROJECTED = ca.fmin(ca.fmax(x, -0.5), 0.75)
ORDERED = Hypothesis("A1", "ordered", Relation(x[1] - x[0], ">=0"))


def claim(expression, sense, **more):
    return Claim("T", "", "", (X, Y), Relation(expression, sense), **more)


CLAIMS = {
    "identity": claim((x[0] + y[0]) ** 2 - x[0] ** 2 - y[0] * (2 * x[0] + y[0]), "==0"),
    "terms": claim(x[0] ** 2 + 3 * y[1] ** 4 + 0.5, ">0", hypotheses=(ORDERED,)),
    "falsifier": claim(x[0] * y[0] - ca.sin(y[1]), "<=0", domain=(BOX,)),
    "products": claim(ca.dot(x, PROJECTED) - ca.sumsqr(PROJECTED), ">=0"),
    "sos": claim(
        2 - ca.sin(x[0]) - ca.cos(x[0]) + y[0] ** 4 - y[0] * y[1] + y[1] ** 2, ">0"
    ),
    "smt": claim(ca.fabs(x[0] + y[0]) - ca.fabs(x[0]) - ca.fabs(y[0]), "<=0"),
    "lmi": DecayClaim(
        "T", "", "", (exact_matrix([[-1, 0.5], [-0.5, 0]]),), Fraction(1, 4)
    ),
}


COUNTS = [40, pytest.param(1000, marks=pytest.mark.slow)]


@functools.cache
def certificate(engine):
    verdict = certify(CLAIMS[engine], engines=(engine,))
    assert verdict.engine == engine, verdict.reason
    return verdict.certificate


def status(document):
    try:
        checked = check_certificate(document)
    except DocumentError:
        return "unreadable"
    return checked.status if checked.holds else "UNKNOWN"


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("engine", CLAIMS)
def test_a_changed_certificate_is_refused(engine, count):
    assert status(certificate(engine)) in ("PROVED", "REFUTED")
    for broken in corruptions(certificate(engine), count):
        assert status(broken) in ("UNKNOWN", "unreadable")


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("engine", CLAIMS)
def test_a_forger_who_renews_the_digest_proves_nothing_else(engine, count):
    """What still holds is the same verdict of the same claim.

    Another witness will do as well, another Q, or -m where m is squared.
    """
    whole = certificate(engine)
    asked = min(count, 5) if engine == "smt" else count  # every time z3 starts anew
    for broken in corruptions(whole, asked, seed=1):
        forged = broken | {"digest": digest(broken)}
        if status(forged) not in ("UNKNOWN", "unreadable"):
            assert status(forged) == whole["status"]
            assert forged["claim"]["fingerprint"] == whole["claim"]["fingerprint"]
            assert check_certificate(forged).fingerprint == CLAIMS[engine].fingerprint
