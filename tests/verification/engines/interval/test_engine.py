"""The interval engine against claims whose truth is known, and its certificates."""

from __future__ import annotations

import base64
import copy
import hashlib
import zlib
from fractions import Fraction

import casadi as ca
import numpy as np
import pytest

from rrnn_opt.check.claims.certificate import check_certificate
from rrnn_opt.claim import Claim, Hypothesis, Range, Relation
from rrnn_opt.errors import DocumentError, RrnnError, UndecidedError
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import certify
from rrnn_opt.verification.engines.interval import engine


def arm() -> tuple[Symbol, ca.SX]:
    """Jacobian of the planar arm 1, 0.8, 0.6 with the first joint at 0."""
    q = Symbol("q", ca.SX.sym("q", 2), "rad", "second and third joint")
    angles = ca.vertcat(0, q.sx[0], q.sx[0] + q.sx[1])
    links = ca.DM([1.0, 0.8, 0.6])
    ends = [ca.SX.zeros(2, 1)]
    for k in range(3):
        step = ca.vertcat(ca.cos(angles[k]), ca.sin(angles[k]))
        ends.append(ends[-1] + links[k] * step)
    columns = [ends[3] - end for end in ends[:3]]
    return q, ca.horzcat(*[ca.vertcat(-c[1], c[0]) for c in columns])


def box(name: str, *sides: tuple[object, object]) -> Range:
    low, high = zip(*sides, strict=True)
    return Range(name, tuple(map(Fraction, low)), tuple(map(Fraction, high)))


def eigenvalue(least: float) -> Claim:
    """lambda_min(J J') > least where sin q2 is at least 1/2 (true least: 0.03509)."""
    q, J = arm()
    M = J @ J.T - least * ca.SX.eye(2)
    return Claim(
        f"eigenvalue-{least}",
        "section 2 of the theorem",
        "both leading minors are positive",
        (q,),
        Relation(ca.vertcat(M[0, 0], ca.det(M)), ">0"),
        domain=(box("q", ("0.5236", "2.6179"), ("-22/7", "22/7")),),
    )


def rate(alpha: float) -> Claim:
    """V' <= -alpha V on the arm, saturation included; e = r (cos t, sin t)."""
    q, J = arm()
    e = Symbol("e", ca.SX.sym("e", 2), "rad and m", "direction and length of the error")
    epsilon, delta = 0.1, 0.25
    y = J.T @ ca.vertcat(ca.cos(e.sx[0]), ca.sin(e.sx[0]))
    velocity = ca.fmin(ca.fmax(e.sx[1] * y / epsilon, -delta), delta)
    return Claim(
        "rate",
        "eqs. (18), (19)",
        "V' <= -alpha V, both divided by -|e|",
        (q, e),
        Relation(ca.dot(y, velocity) - alpha * e.sx[1] / 2, ">=0"),
        domain=(
            box("q", ("0.5236", "2.6179"), ("-2.4", "2.4")),
            box("e", ("-22/7", "22/7"), ("0.01", "0.5")),
        ),
        order="first-order",
        jacobian="moving",
    )


def test_bound_below_the_true_one_is_proved_and_above_it_refuted():
    assert certify(eigenvalue(0.035)).status == "PROVED"
    broken = certify(eigenvalue(0.0352), engines=["interval"])
    assert broken.status == "REFUTED"
    assert broken.engine == "interval"
    assert broken.trust == "arb"


@pytest.mark.slow
def test_rate_of_the_saturated_planar_arm():
    verdict = certify(rate(0.05))
    assert (verdict.status, verdict.trust) == ("PROVED", "interval")
    assert certify(rate(5.0), engines=["interval"]).status == "REFUTED"


def test_small_proofs_are_confirmed_in_balls_throughout():
    x = Symbol("x", ca.SX.sym("x"), "1", "a number")
    claim = Claim(
        "wave",
        "",
        "sin x <= x on [0.5, 100]",
        (x,),
        Relation(x.sx - ca.sin(x.sx), ">0"),
        domain=(box("x", ("0.5", "100")),),
    )
    verdict = certify(claim, engines=["interval"])
    assert (verdict.status, verdict.trust) == ("PROVED", "arb")


def test_hypotheses_cut_the_domain():
    x = Symbol("x", ca.SX.sym("x", 2), "1", "a point")
    inside = Relation(ca.sumsqr(x.sx) - 1, "<=0")
    claim = Claim(
        "disc",
        "",
        "x + y <= 1.5 on the unit disc",
        (x,),
        Relation(x.sx[0] + x.sx[1] - 1.5, "<=0"),
        (Hypothesis("A1", "in the disc", inside),),
        domain=(box("x", (-2, 2), (-2, 2)),),
    )
    assert certify(claim, engines=["interval"]).status == "PROVED"
    free = Claim("square", "", "", (x,), claim.goal, domain=claim.domain)
    assert certify(free, engines=["interval"]).status == "REFUTED"


@pytest.mark.parametrize(
    ("expression", "word"),
    [
        pytest.param(lambda x: 1 / (x * x), "not defined", marks=pytest.mark.slow),
        (lambda x: ca.sqrt(x) + 1, "not defined"),
        (ca.exp, "exp"),
        (lambda x: (3 * x - 1) ** 2, "tight"),
        (lambda x: ca.floor(x) + 5, "floor"),
    ],
)
def test_what_cannot_be_shown_stays_open(expression, word):
    x = Symbol("x", ca.SX.sym("x"), "1", "a number")
    goal = Relation(expression(x.sx), ">0" if word == "tight" else ">=0")
    claim = Claim("open", "", "", (x,), goal, domain=(box("x", ("-1/3", "1")),))
    verdict = certify(claim, engines=["interval"], budget_s=20.0)
    assert verdict.status == "UNKNOWN"
    assert word in verdict.reason


def test_a_jump_is_not_taken_for_flat():
    """The derivative of a step is 0 almost everywhere; the step is there still."""
    x = Symbol("x", ca.SX.sym("x"), "1", "a number")
    step = ca.if_else(x.sx > 0.75, -1, 1)
    claim = Claim(
        "step", "", "", (x,), Relation(step, ">0"), domain=(box("x", (0, 1)),)
    )
    verdict = certify(claim, engines=["interval"], budget_s=2.0)
    assert verdict.status != "PROVED"


def test_unbounded_domain_is_said():
    x = Symbol("x", ca.SX.sym("x"), "1", "a number")
    claim = Claim("free", "", "", (x,), Relation(x.sx * x.sx + 1, ">0"))
    with pytest.raises(UndecidedError, match="'x' has no bounds"):
        list(engine.propose(claim, budget_s=1.0, seed=0))


@pytest.fixture(scope="module")
def certificate():
    (document,) = engine.propose(eigenvalue(0.03), budget_s=300.0, seed=0)
    assert check_certificate(document).status == "PROVED"
    return document


def corrupted(document, rng):
    """One digit, sign, operation or byte of a certificate changed."""
    out = copy.deepcopy(document)
    kind = rng.integers(5)
    if kind == 0:
        text = list(out["payload"]["tree"])
        at = rng.integers(len(text))
        text[at] = "A" if text[at] != "A" else "B"
        out["payload"]["tree"] = "".join(text)
    elif kind == 1:
        name = rng.choice(["nodes", "sha256"])
        out["payload"][name] = out["payload"][name] * 2
    elif kind == 2:
        step = out["claim"]["tape"][rng.integers(len(out["claim"]["tape"]))]
        step[0] = "sub" if step[0] != "sub" else "add"
    elif kind == 3:
        out["claim"]["senses"] = ["<0"]
    else:
        side = rng.choice(["lower", "upper"])
        out["claim"]["domain"][0][side][rng.integers(2)] = "3/7"
    return out


def test_corrupted_certificates_are_refused(certificate):
    rng = np.random.default_rng(0)
    for _ in range(1000):
        try:
            answer = check_certificate(corrupted(certificate, rng))
        except (DocumentError, RrnnError):
            continue
        assert answer.status == "UNKNOWN"


def test_a_tree_that_was_signed_again_must_still_prove(certificate):
    """Cutting less, or elsewhere, is no forgery unless a leaf fails: then it is."""
    payload = certificate["payload"]
    data = bytearray(zlib.decompress(base64.b64decode(payload["tree"])))
    rng = np.random.default_rng(1)
    refused = 0
    for _ in range(16):
        other = bytearray(data)
        at = int(rng.integers(len(other)))
        other[at] = int(rng.choice([0, 1, 2, 253, 254, 255]))
        signed = payload | {
            "tree": base64.b64encode(zlib.compress(bytes(other))).decode(),
            "sha256": hashlib.sha256(bytes(other)).hexdigest(),
        }
        answer = check_certificate(certificate | {"payload": signed})
        refused += answer.status == "UNKNOWN"
    assert refused >= 8
    root = bytes([255])
    signed = payload | {
        "tree": base64.b64encode(zlib.compress(root)).decode(),
        "sha256": hashlib.sha256(root).hexdigest(),
        "nodes": 1,
    }
    assert check_certificate(certificate | {"payload": signed}).status == "UNKNOWN"
