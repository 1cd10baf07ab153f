"""Proofs by lemmas, on statements whose truth is known."""

from __future__ import annotations

import contextlib
import copy
from fractions import Fraction

import casadi as ca
import numpy as np
import pytest

from rrnn_opt.check.claims.certificate import check_certificate
from rrnn_opt.claim import Claim, Hypothesis, Range, Relation
from rrnn_opt.errors import DocumentError, RrnnError
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import Given, Instance, Proof, Square

A, B = Symbol.scalar("a"), Symbol.scalar("b")
X = Symbol.vector("x", 3)
a, b, x = A.sx, B.sx, X.sx
POSITIVE = Range("a", (Fraction(0),), (None,))


def make(expression, sense, variables, **more):
    return Claim("T", "", "", variables, Relation(expression, sense), **more)


AM_GM = make((a**2 + b**2) ** 2 - 4 * a**2 * b**2, ">=0", (A, B))
"""No term shows it; a square does."""
SHOWN = Proof(AM_GM, terms=((Square(a**2 - b**2),),))
PRODUCT = make(
    a * b, ">=0", (A, B), domain=(POSITIVE, Range("b", (Fraction(0),), (None,)))
)


def test_a_square_proves():
    verdict = SHOWN.settle()
    assert (verdict.status, verdict.trust, verdict.engine) == (
        "PROVED",
        "exact",
        "composite",
    )
    assert check_certificate(verdict.certificate).holds


def test_a_wrong_square_does_not():
    assert Proof(AM_GM, terms=((Square(a**2),),)).settle().status == "UNKNOWN"


@pytest.mark.parametrize(
    ("term", "said"),
    [
        (Instance(1, {"a": a, "b": b}), "lemma 1 of 1, from 0"),
        (Instance(0, {"a": a}), "lemma 'T' is of a, b"),
        (Square(ca.SX.sym("z")), "terms: depends on z"),
        (Instance(0, {"a": a, "b": ca.SX.sym("z")}), "terms: depends on z"),
    ],
)
def test_a_term_that_makes_no_sense_is_named(term, said):
    with pytest.raises(RrnnError, match=said):
        Proof(AM_GM, (AM_GM,), ((term,),)).document([])


def summed(**more):
    value = sum(
        (x[k] ** 2 + x[k - 1] ** 2) ** 2 - 4 * x[k] ** 2 * x[k - 1] ** 2
        for k in range(3)
    )
    return make(value, ">=0", (X,), **more)


def uses(factor=1):
    return (
        tuple(
            Instance(0, {"a": x[k], "b": x[k - 1]}, factor=ca.SX(factor))
            for k in range(3)
        ),
    )


def test_instances_of_a_lemma_add_up():
    verdict = Proof(summed(), (SHOWN,), uses()).settle()
    assert verdict.status == "PROVED"
    assert Proof(summed(), (SHOWN,), uses(-1)).settle().status == "UNKNOWN"
    assert Proof(summed(), (SHOWN,), (uses()[0][:2],)).settle().status == "UNKNOWN"


def test_an_unproved_lemma_is_named():
    false = make(a, ">=0", (A, B))
    verdict = Proof(summed(), (false,), uses()).settle()
    assert "lemma 'T': REFUTED" in verdict.reason


def test_a_lemma_needs_its_domain_where_it_is_used():
    goal = make(x[0] * x[1], ">=0", (X,))
    proof = ((Instance(0, {"a": x[0], "b": x[1]}),),)
    assert "hypotheses may fail" in Proof(goal, (PRODUCT,), proof).settle().reason
    given = Hypothesis("A1", "positive", Relation(x[:2], ">=0"))
    goal = make(x[0] * x[1], ">=0", (X,), hypotheses=(given,))
    assert Proof(goal, (PRODUCT,), proof).settle().status == "PROVED"
    part = Range("x", (Fraction(1), Fraction(0), None), (None,) * 3)
    goal = make(x[0] * x[1], ">=0", (X,), domain=(part,))
    assert Proof(goal, (PRODUCT,), proof).settle().status == "PROVED"


def test_equations_take_any_factor():
    given = Hypothesis("A1", "on the line", Relation(a - b, "==0"), added=True)
    goal = make(a**3 - b**3, "==0", (A, B), hypotheses=(given,))
    factor = a**2 + a * b + b**2
    verdict = Proof(goal, terms=((Given(0, factor=factor),),)).settle()
    assert (verdict.status, verdict.assumptions) == (
        "HOLDS_UNDER",
        ("A1: on the line",),
    )
    lower = Hypothesis("A1", "below", Relation(a - b, ">=0"))
    goal = make(a**3 - b**3, ">=0", (A, B), hypotheses=(lower,))
    assert Proof(goal, terms=((Given(0, factor=factor),),)).settle().status == "UNKNOWN"


def test_rules_are_assumptions_and_the_weakest_trust_wins():
    verdict = Proof(AM_GM, (SHOWN,), rules=("LaSalle",)).settle()
    assert verdict.status == "HOLDS_UNDER"
    assert (verdict.assumptions, verdict.trust) == (("pen: LaSalle",), "pen")


def test_a_strict_goal_needs_something_positive():
    goal = make(a**2 - 2 * a * b + b**2, ">0", (A, B))
    assert Proof(goal, terms=((Square(a - b),),)).settle().status == "UNKNOWN"
    goal = make(a**2 - 2 * a * b + b**2 + 1, ">0", (A, B))
    assert Proof(goal, terms=((Square(a - b),),)).settle().status == "PROVED"


def corruptions(document):
    payload = document["payload"]

    def changed(change):
        broken = copy.deepcopy(document)
        change(broken["payload"])
        return broken

    yield changed(lambda p: p["parts"].pop())
    yield changed(lambda p: p["parts"][0].update(method="identity"))
    yield changed(lambda p: p["combination"]["elements"][0].pop())
    yield changed(lambda p: p["combination"]["elements"].append([]))
    yield changed(lambda p: p.update(combination=None))
    for k, step in enumerate(payload["combination"]["tape"]):
        if step[3] is not None:
            yield changed(
                lambda p, k=k: p["combination"]["tape"][k].__setitem__(3, (-1.0).hex())
            )


def test_corrupted_proofs_prove_nothing():
    document = Proof(summed(), (SHOWN,), uses()).settle().certificate
    assert check_certificate(document).status == "PROVED"
    every = list(corruptions(document))
    assert len(every) >= 6
    for broken in every:
        with contextlib.suppress(DocumentError):
            assert check_certificate(broken).status == "UNKNOWN"


@pytest.mark.parametrize("rules", [("",), ("LaSalle",)])
def test_rules_cannot_be_dressed_up(rules):
    document = Proof(AM_GM, (SHOWN,), rules=rules).settle().certificate
    document["payload"]["rules"] = []
    assert not check_certificate(document).holds  # it says HOLDS_UNDER


def leaves(value, path=()):
    """Every number and word of a document, with its place."""
    items = value.items() if isinstance(value, dict) else enumerate(value)
    for key, inner in items:
        if isinstance(inner, dict | list):
            yield from leaves(inner, (*path, key))
        elif not isinstance(inner, bool) and inner is not None:
            yield (*path, key)


def altered(document, path, rng):
    broken = copy.deepcopy(document)
    place = broken
    for key in path[:-1]:
        place = place[key]
    old = place[path[-1]]
    if isinstance(old, int):
        place[path[-1]] = old + int(rng.choice([-1, 1]))
    elif old.startswith(("0x", "-0x")):
        place[path[-1]] = (-float.fromhex(old) or 1.0).hex()
    else:
        place[path[-1]] = {"add": "sub", "mul": "add", "sq": "neg"}.get(old, old + "1")
    return broken


def test_a_changed_digit_or_sign_is_seen():
    """What survives is a name, or another proof of the very same claim."""
    document = Proof(summed(), (SHOWN,), uses()).settle().certificate
    shown = {"id", "source", "statement", "versions", "schema", "witness", "reason"}
    rng = np.random.default_rng(0)
    places = [p for p in leaves(document) if not shown & set(map(str, p))]
    assert len(places) > 200
    survived = []
    for path in places:
        with contextlib.suppress(DocumentError):
            if check_certificate(altered(document, path, rng)).holds:
                survived.append(path)
    assert len(survived) < 0.1 * len(places)
    for path in survived:
        assert path[:2] == ("payload", "combination"), path
