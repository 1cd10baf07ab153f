"""A point that keeps the hypotheses also keeps what a proof assumes to be defined."""

from __future__ import annotations

from fractions import Fraction

import casadi as ca
import pytest

from rrnn_opt.check.claims.certificate import check_certificate
from rrnn_opt.check.claims.document import read_claim
from rrnn_opt.claim import Claim, Range, Relation
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification.document import certificate_document

pytest.importorskip("z3", reason="pip install z3-solver")

X = Symbol.scalar("x")
x = X.sx
UNIT = Range("x", (Fraction(0),), (Fraction(1),))


def document(expression, *, at=Fraction(1, 2)):
    claim = Claim("T", "", "", (X,), Relation(expression, ">0"), domain=(UNIT,))
    return certificate_document(
        claim, "smt", payload={"solvers": ["z3"]}, witness={"x": (at,)}
    )


def test_what_is_never_defined_is_not_assumed():
    """The root is behind a branch that is never taken, and there for no real x."""
    nowhere = ca.if_else(x <= -1, ca.sqrt(-1 - x**2), 0)
    assert check_certificate(document(x - 5 + nowhere)).status == "UNKNOWN"


def test_what_no_result_needs_is_asked_for_as_well():
    forged = document(x - 5)
    tape = forged["claim"]["tape"]
    minus = ["const", 0, [], (-1.0).hex(), None], ["sqrt", 1, [0], None, None]
    moved = [
        [op, out + 2 if out >= 0 else out, [a + 2 for a in args], const, slot]
        for op, out, args, const, slot in tape
    ]
    forged["claim"]["tape"] = [*minus, *moved]
    forged["claim"]["fingerprint"] = read_claim(forged["claim"]).fingerprint
    assert check_certificate(forged).status == "UNKNOWN"


def test_what_is_defined_at_the_point_may_be_assumed():
    checked = check_certificate(document(ca.sqrt(x) + 1))
    assert checked.status == "HOLDS_UNDER"
    assert "(sqrt)" in checked.assumptions[0]
