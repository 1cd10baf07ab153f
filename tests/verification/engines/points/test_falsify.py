"""Witnesses on guarded domains, of tight and strict goals; and what is no input."""

from __future__ import annotations

import math
from fractions import Fraction

import casadi as ca
import pytest

from rrnn_opt.check.claims.certificate import check_certificate
from rrnn_opt.claim import Claim, Hypothesis, Range, Relation
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import certify
from rrnn_opt.verification.document import certificate_document
from rrnn_opt.verification.engines.points.falsify import (
    candidates,
    keepers,
    worth_replaying,
)

X, Y = Symbol.scalar("x"), Symbol.vector("y", 2)
x, y = X.sx, Y.sx


def claim(expression, sense, *given, **more):
    pairs = enumerate(given, start=1)
    hypotheses = tuple(Hypothesis(f"A{k}", "", Relation(*g)) for k, g in pairs)
    relation = Relation(expression, sense)
    return Claim("T", "", "", (X, Y), relation, hypotheses=hypotheses, **more)


@pytest.mark.parametrize(
    "stated",
    [
        # a thin ring, and a thin wedge of it
        claim(y[0], ">=0", (1 - ca.sumsqr(y), ">=0"), (ca.sumsqr(y) - 0.99, ">=0")),
        claim(y[1] - 0.98, "<=0", (1 - ca.sumsqr(y), ">0"), (y[0] ** 2 - 0.01, "<=0")),
        # the only breach is near a corner of the guards
        claim(x - 2.999, "<0", (x + y[0] - 3, "<=0"), (y[0], ">=0")),
        # strict goals that vanish at simple points
        claim((3 * x - 1) ** 2, ">0"),
        claim((4 * x - 1) ** 2 + (12 * y[0] - 5) ** 2, ">0"),
        claim(1 - ca.cos(x), ">0", domain=(Range("x", (Fraction(-1),), (None,)),)),
        # one element of many
        claim(ca.vertcat(x**2, y[0] ** 2, y[1] + 1e6), ">=0", (y[1] + 2e6, ">=0")),
    ],
)
def test_breaches_are_found_and_replayed(stated):
    verdict = certify(stated, engines=("falsifier",))
    assert verdict.status == "REFUTED", verdict.reason
    document = certificate_document(
        stated, "replay",
        witness={k: tuple(map(Fraction, v)) for k, v in verdict.witness.items()},
    )  # fmt: skip
    assert check_certificate(document).status == "REFUTED"


@pytest.mark.parametrize(
    "stated",
    [
        claim(x**2 + 1, ">0"),
        claim(1 - ca.sumsqr(y), ">=0", (1 - ca.sumsqr(y), ">=0")),
        claim(ca.sin(x) - 1, "<=0"),
    ],
)
def test_true_claims_are_not_refuted(stated):
    assert certify(stated, engines=("falsifier",)).status == "UNKNOWN"


def test_what_breaks_by_rounding_alone_is_not_worth_a_replay():
    stated = claim(0.1 * 3 * x - 0.3 * x, "==0")
    assert not worth_replaying(stated, {"x": [Fraction(1)], "y": [Fraction(0)] * 2})
    assert list(candidates(stated)) == []


def test_keepers_reach_small_guarded_sets():
    small = claim(x, ">=0", (1e-4 - ca.sumsqr(y - 3), ">=0"), (x - 50, ">0"))
    found = next(keepers(small))
    assert sum((v - 3) ** 2 for v in found["y"]) <= Fraction(1e-4)
    assert found["x"][0] > 50


@pytest.mark.parametrize(
    ("stated", "reason"),
    [
        (claim(x * math.nan + y[0], ">=0"), "not a real number"),
        (claim(x + math.inf, ">=0"), "not a real number"),
        (claim(ca.erf(x), ">=0"), "not supported"),
        (claim(ca.exp(x) - x, ">0"), "no translation to SMT"),
        (claim(x**2, ">=0", (x, ">0"), (x, "<0")), "contradict each other"),
        (claim(ca.exp(x), ">=0", (ca.exp(x) + 1, "<0")), "no point"),
        (claim(x / 0.0, ">=0"), "not a real number"),
        (claim(x / y[0], ">=0", (y[0], "==0")), "undefined"),
    ],
)
def test_bad_input_is_unknown_with_the_reason(stated, reason):
    verdict = certify(stated, budget_s=10)
    assert verdict.status == "UNKNOWN"
    assert reason in verdict.reason, verdict.reason


def test_an_unbounded_domain_is_no_obstacle_to_algebra():
    verdict = certify(claim(x**2 - 2 * x + 1, ">=0"))
    assert (verdict.status, verdict.trust) == ("PROVED", "exact")
