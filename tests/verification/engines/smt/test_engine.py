"""z3 and cvc5 as finders, and the checker that asks them again."""

from __future__ import annotations

from fractions import Fraction

import casadi as ca
import pytest

from rrnn_opt.check.claims.certificate import check_certificate
from rrnn_opt.check.claims.methods import smt as claim_smt
from rrnn_opt.claim import Claim, Hypothesis, Range, Relation
from rrnn_opt.errors import DocumentError, UndecidedError
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import certify
from rrnn_opt.verification.document import certificate_document
from rrnn_opt.verification.engines.smt import engine as smt
from rrnn_opt.verification.engines.smt.engine import SmtAnswer

X, Y = Symbol.scalar("x"), Symbol.scalar("y")
x, y = X.sx, Y.sx
TRIANGLE = ca.fabs(x + y) - ca.fabs(x) - ca.fabs(y)


def claim(expression, sense, **more):
    return Claim("T", "", "", (X, Y), Relation(expression, sense), **more)


def smt_only(stated):
    return certify(stated, engines=("smt",))


@pytest.mark.parametrize(
    ("stated", "status"),
    [
        (claim(TRIANGLE, "<=0"), "PROVED"),
        (claim(TRIANGLE + 0.25, "<=0"), "REFUTED"),
        (claim(ca.sin(x + y) - ca.sin(x) * ca.cos(y) - ca.cos(x) * ca.sin(y), "==0"),
         "PROVED"),
        (claim(ca.sin(2 * x) - 2 * ca.sin(x) * ca.cos(x), "==0"), "PROVED"),
        pytest.param(claim(ca.sin(x) * ca.cos(x) - 0.5, "<=0"), "PROVED",
                     marks=pytest.mark.slow),
        (claim(ca.sin(x) * ca.cos(x) - 0.4, "<=0"), "REFUTED"),
        (claim(x**2 - 2, ">=0"), "REFUTED"),
        # the pair forgets which angle it is: sin x <= x is beyond it, no witness
        (claim(ca.sin(x) - x, "<=0", domain=(Range("x", (Fraction(0),), (None,)),)),
         "UNKNOWN"),
        (claim(ca.sqrt(x) - 1, ">=0",
               domain=(Range("x", (Fraction(1),), (None,)),)), "HOLDS_UNDER"),
        (claim(ca.exp(x), ">0"), "UNKNOWN"),
    ],
)  # fmt: skip
def test_verdicts(stated, status):
    verdict = smt_only(stated)
    assert verdict.status == status, verdict.reason
    if status == "PROVED":
        assert verdict.trust == "smt"


def test_the_checker_wants_unsat_from_every_named_solver(monkeypatch):
    document = certificate_document(
        claim(TRIANGLE, "<=0"), "smt", payload={"solvers": ["z3", "cvc5"]}
    )
    said = {"z3": "unsat", "cvc5": "unknown"}
    monkeypatch.setattr(claim_smt, "run", lambda solver, *_: said[solver])
    checked = check_certificate(document)
    assert (checked.status, checked.reason) == ("UNKNOWN", "cvc5 says unknown")
    said["cvc5"] = "unsat"
    assert check_certificate(document).status == "PROVED"


@pytest.mark.parametrize(
    "payload", [None, {}, {"solvers": []}, {"solvers": ["z4"]}, {"solvers": ["z3"] * 2}]
)
def test_the_payload_names_solvers(payload):
    document = certificate_document(claim(TRIANGLE, "<=0"), "smt", payload=payload)
    with pytest.raises(DocumentError, match="solvers"):
        check_certificate(document)


def test_a_false_claim_is_not_proved_by_the_checker():
    stated = claim(TRIANGLE + 0.25, "<=0")
    document = certificate_document(stated, "smt", payload={"solvers": ["z3"]})
    assert check_certificate(document).reason == "z3 says sat"


def test_solvers_that_disagree_are_not_believed(monkeypatch):
    answers = {"z3": SmtAnswer("unsat", {}), "cvc5": SmtAnswer("sat", {})}
    monkeypatch.setattr(smt, "ask", lambda query, solver, wall: answers[solver])
    monkeypatch.setattr(smt.importlib.util, "find_spec", lambda name: name)
    with pytest.raises(UndecidedError, match="nothing is believed"):
        list(smt.propose(claim(TRIANGLE, "<=0"), budget_s=5, seed=0))


def test_a_solver_is_killed_at_its_wall_limit(monkeypatch, tmp_path):
    sleeper = tmp_path / "sleeper.py"
    sleeper.write_text("import time\ntime.sleep(60)\n")
    monkeypatch.setattr(smt, "WORKER", sleeper)
    monkeypatch.setattr(smt, "GRACE_S", 0.1)
    with pytest.raises(UndecidedError, match=r"no answer in 0\.2 s"):
        list(smt.propose(claim(TRIANGLE, "<=0"), budget_s=0.2, seed=0))


def test_a_solver_that_crashes_is_unknown(monkeypatch, tmp_path):
    crash = tmp_path / "crash.py"
    crash.write_text("import os\nos.abort()\n")
    monkeypatch.setattr(smt, "WORKER", crash)
    verdict = smt_only(claim(TRIANGLE, "<=0"))
    assert verdict.status == "UNKNOWN"
    assert "stopped with status" in verdict.reason


def test_models_find_points_that_keep_equations():
    given = Hypothesis("A1", "", Relation(3 * x + 7 * y**3 - 10, "==0"))
    verdict = certify(claim((x - 1) ** 2 + 1, ">0", hypotheses=(given,)))
    assert verdict.status == "PROVED"
    a, b = (Fraction(verdict.certificate["witness"][name][0]) for name in "xy")
    assert 3 * a + 7 * b**3 == 10
