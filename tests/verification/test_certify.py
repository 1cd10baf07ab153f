"""The engines together, on claims whose truth is known."""

from __future__ import annotations

from fractions import Fraction

import casadi as ca
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import rrnn_opt as rr
from rrnn_opt.check.claims.certificate import check_certificate
from rrnn_opt.claim import Claim, Hypothesis, Range, Relation
from rrnn_opt.errors import CompilerError, RrnnError
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import ClaimCase, Mutation, Status, certify, verdict_row
from rrnn_opt.verification.engines.interval.kernel import IntervalKernel
from rrnn_opt.verification.engines.points.falsify import candidates

X, Y = Symbol.scalar("x"), Symbol.vector("y", 2)
x, y = X.sx, Y.sx
UNIT = Range("x", (Fraction(0),), (Fraction(1),))


def claim(expression, sense="==0", **more):
    return Claim("T", "test", "words", (X, Y), Relation(expression, sense), **more)


@pytest.mark.parametrize(
    ("stated", "status", "engine"),
    [
        (
            claim(ca.sin(x + y[0]) * 2 - ca.sin(y[0] + x) - ca.sin(x + y[0])),
            "PROVED",
            "identity",
        ),
        (claim(x**2 + y[0] ** 2, ">=0"), "PROVED", "terms"),
        (claim(x**2 + y[0] ** 2, ">0"), "REFUTED", "falsifier"),
        (claim(ca.sin(x) - x), "REFUTED", "falsifier"),
        (claim(x * (1 - x), ">=0"), "REFUTED", "falsifier"),
        (claim(x * (1 - x), ">=0", domain=(UNIT,)), "PROVED", "products"),
        (claim(ca.exp(x) - 1 - x, ">=0"), "UNKNOWN", ""),
        (
            claim(
                ca.sqrt(x * y[0]) * ca.sqrt(y[1]) - ca.sqrt(x * y[0] * y[1]),
                "<=0",
                domain=(UNIT, Range("y", (Fraction(0),) * 2, (None,) * 2)),
            ),
            "HOLDS_UNDER",
            "smt",
        ),
        (claim((x + y[0]) / y[1] - x / y[1] - y[0] / y[1]), "HOLDS_UNDER", "identity"),
    ],
)
def test_verdicts(stated, status, engine):
    verdict = certify(stated)
    assert (verdict.status, verdict.engine) == (status, engine)
    if verdict.certificate is not None:
        assert check_certificate(verdict.certificate).status == status


def test_the_verb_is_at_the_top():
    assert (rr.Relation, rr.Hypothesis, rr.Range) == (Relation, Hypothesis, Range)
    assert rr.certify is certify
    assert rr.certify(claim(x - x + y[0] - y[0])).status is Status.PROVED


def test_given_witnesses_come_first_and_are_exact():
    third = {"x": [Fraction(1, 3)], "y": [0.1, 0]}
    verdict = certify(claim(3 * x - 1, ">0"), witnesses=(third,))
    assert verdict.engine == "witness"
    assert verdict.witness == {"x": ["1/3"], "y": [str(Fraction(0.1)), "0"]}


@pytest.mark.parametrize(
    "bad",
    [
        {"x": [1]},
        {"x": [np.nan], "y": [0, 0]},
        {"x": [1], "y": [0]},
        {"x": 1, "y": [0, 0]},
        "x",
    ],
)
def test_bad_witnesses_are_named(bad):
    with pytest.raises(RrnnError, match="witness"):
        certify(claim(x, ">=0"), witnesses=(bad,))


def test_hypotheses_in_words_forbid_a_refutation():
    worded = Hypothesis("A1", "the noise is independent")
    assert certify(claim(x, hypotheses=(worded,))).status is Status.UNKNOWN


def test_a_refutation_keeps_the_hypotheses():
    ordered = Hypothesis("A1", "ordered", Relation(y[1] - y[0], ">=0"))
    stated = claim(y[0] - x, ">=0", hypotheses=(ordered,), domain=(UNIT,))
    witness = certify(stated).witness
    low, high = (Fraction(value) for value in witness["y"])
    assert low <= high
    assert low < Fraction(witness["x"][0]) <= 1


def test_a_breach_of_rounding_size_is_no_witness():
    stated = claim((0.1 * 3) * x * y[0] - 0.3 * (y[0] * x))
    verdict = certify(stated)
    assert verdict.status is Status.UNKNOWN
    assert "largest coefficient" in verdict.reason


def test_contradictory_hypotheses_prove_nothing():
    positive = Hypothesis("A1", "", Relation(x, ">0"))
    negative = Hypothesis("A2", "", Relation(x, "<=0"))
    verdict = certify(claim(x**2, ">=0", hypotheses=(positive, negative)))
    assert verdict.status is Status.UNKNOWN
    assert "the hypotheses contradict each other" in verdict.reason
    assert certify(claim(x**2, ">=0", hypotheses=(positive,))).status == "PROVED"


def test_engines_can_be_chosen():
    assert certify(claim(x**2, ">=0"), engines=("terms",)).engine == "terms"
    assert certify(claim(x**2, ">=0"), engines=("identity",)).status == "UNKNOWN"
    with pytest.raises(RrnnError, match="use one of identity, terms"):
        certify(claim(x), engines=("oracle",))


def test_without_a_compiler_the_other_engines_go_on(monkeypatch):
    def none(*_):
        raise CompilerError("there is no C compiler")

    monkeypatch.setattr(IntervalKernel, "of", none)
    box = (Range("x", (-1,), (2,)), Range("y", (0, 0), (1, 1)))
    bowl = claim(x**2 - 2 * x + 1.5, ">0", domain=box)
    verdict = certify(bowl, engines=["interval"])
    assert verdict.residue == ("interval: there is no C compiler",)
    assert certify(bowl, engines=["interval", "sos"]).status == "PROVED"


def test_an_operation_outside_the_table_is_unknown():
    verdict = certify(claim(ca.erf(x) - ca.erf(y[0])))
    assert verdict.status is Status.UNKNOWN
    assert "not supported" in verdict.reason


def test_the_search_is_seeded():
    stated = claim(x - y[0] ** 2, ">=0")
    assert list(candidates(stated, seed=3)) == list(candidates(stated, seed=3))
    assert list(candidates(stated, seed=3)) != list(candidates(stated, seed=4))


def test_rows_have_the_agreed_form():
    stated = claim(x**2, ">=0", order="first-order", jacobian="moving")
    mutation = Mutation("sign flipped", claim(-(x**2), ">=0"))
    settled = ClaimCase(stated, mutation).settle()
    assert settled.caught
    row = settled.row(place=lambda name, certificate: f"{name}.json")
    assert row["certificate"] == "T.json"
    assert row["mutation"] == "sign flipped: REFUTED"
    assert row["verdict"] == "PROVED"
    assert (row["id"], row["dynamics"], row["jacobian"]) == (
        "T",
        "first-order",
        "moving",
    )
    assert {
        "id", "source", "statement", "dynamics", "jacobian", "verdict", "assumptions",
        "witness", "engine", "trust", "mutation", "time_s", "certificate",
    } <= set(row)  # fmt: skip
    assert verdict_row(stated, settled.verdict)["certificate"] is None


def test_a_mutation_that_slips_through_is_seen():
    true, false = claim(x**2, ">=0"), claim(-(x**2), ">=0")
    assert not ClaimCase(true, Mutation("nothing changed", true)).settle().caught
    assert not ClaimCase(false, Mutation("none", false, holds=True)).settle().caught
    assert ClaimCase(false, Mutation("mended", true, holds=True)).settle().caught
    assert ClaimCase(true).settle().caught


coefficients = st.lists(st.integers(-3, 3), min_size=4, max_size=4)


@settings(max_examples=25)
@given(coefficients)
def test_cubics_are_never_misjudged(c):
    """Against exact values on a grid and the sign of the coefficients."""
    cubic = c[0] + c[1] * x + c[2] * x**2 + c[3] * x**3
    stated = claim(cubic, ">=0", domain=(UNIT,))
    status = certify(stated, engines=("terms", "falsifier")).status
    values = [sum(a * Fraction(k, 16) ** n for n, a in enumerate(c)) for k in range(17)]
    if min(values) < 0:
        assert status is not Status.PROVED
    if min(c) >= 0:
        assert status is Status.PROVED
