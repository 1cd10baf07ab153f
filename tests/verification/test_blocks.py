"""Building blocks of claims on the open-set trap, the step bound and the rate."""

from __future__ import annotations

from fractions import Fraction

import casadi as ca
import numpy as np
import pytest

from rrnn_opt.claim import Claim, Range, Relation
from rrnn_opt.errors import RrnnError, ShapeError
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import certify
from rrnn_opt.verification.blocks import curvature_claim, inward_claims, rate_claim

EPSILON, GAIN, SPEED = 0.1, 0.5, 1.0
BOX = (
    (Fraction(-1, 50), Fraction(0)),
    (Fraction(-16208, 10000), Fraction(-15208, 10000)),
)


def status(claim: Claim) -> str:
    return str(certify(claim, engines=["interval"], budget_s=300.0).status)


def elbow() -> tuple[Symbol, ca.SX, ca.SX]:
    """The 2R arm with unit links: joints, position, Jacobian."""
    q = Symbol("q", ca.SX.sym("q", 2), "rad", "joints")
    a, b = q.sx[0], q.sx[0] + q.sx[1]
    p = ca.vertcat(ca.cos(a) + ca.cos(b), ca.sin(a) + ca.sin(b))
    return q, p, ca.jacobian(p, q.sx)


def trap(upper: float) -> tuple[Symbol, ca.SX, ca.SX]:
    """State, velocity and error of (18) with the first joint's limit at ``upper``."""
    q, p, J = elbow()
    error = ca.DM([1.0, -0.9]) - p
    low = ca.vertcat(ca.fmax(-SPEED, -GAIN * (q.sx[0] + 3)), -SPEED)
    high = ca.vertcat(ca.fmin(SPEED, -GAIN * (q.sx[0] - upper)), SPEED)
    velocity = ca.fmin(ca.fmax(J.T @ error / EPSILON, low), high)
    return q, velocity, error


def test_open_set_that_never_reaches_its_target():
    q, velocity, error = trap(0.0)
    claims = inward_claims("trap", "after eq. (21)", q, velocity, BOX)
    assert [status(claim) for claim in claims] == ["PROVED"] * 4
    low, high = zip(*BOX, strict=True)
    away = Claim(
        "away",
        "after eq. (21)",
        "the error stays above 0.07",
        (q,),
        Relation(ca.sumsqr(error) - 0.0049, ">0"),
        domain=(Range("q", low, high),),
    )
    assert status(away) == "PROVED"


def test_without_the_limit_the_set_is_left():
    q, velocity, _ = trap(1.0)
    claims = inward_claims("open", "", q, velocity, BOX)
    assert status(claims[1]) == "REFUTED"


@pytest.mark.parametrize(("bound", "verdict"), [("8", "PROVED"), ("1/2", "REFUTED")])
def test_step_bound(bound, verdict):
    q, p, _ = elbow()
    e = Symbol("e", ca.SX.sym("e", 2), "m", "error")
    tenth = Fraction(1, 10)
    domain = (
        Range("q", (Fraction(-1), Fraction(0)), (Fraction(1), Fraction(2))),
        Range("e", (-tenth, -tenth), (tenth, tenth)),
    )
    claim = curvature_claim("L", "", q, p, e, Fraction(bound), domain)
    assert status(claim) == verdict
    hessian = ca.Function(
        "H",
        [q.sx, e.sx],
        [ca.hessian(ca.sumsqr(e.sx + ca.DM([1, 0]) - p) / 2, q.sx)[0]],
    )
    if verdict == "PROVED":
        rng = np.random.default_rng(0)
        for _ in range(50):
            point = rng.uniform([-1, 0], [1, 2])
            f = np.array(ca.Function("f", [q.sx], [p])(point)).ravel()
            wanted = rng.uniform(-0.1, 0.1, 2)
            value = np.array(hessian(point, wanted + f - [1, 0]))
            assert np.linalg.norm(value, 2) <= float(Fraction(bound))


def test_rate_needs_a_positive_length_and_a_planar_task():
    q, _, J = elbow()
    polar = Symbol("e", ca.SX.sym("e", 2), "rad and m", "error")
    zero, one = Fraction(0), Fraction(1)
    numbers = {"epsilon": 0.1, "delta": 0.2, "alpha": 0.01}
    domain = (Range("q", (zero, one), (one, one)), Range("e", (zero, zero), (one, one)))
    with pytest.raises(RrnnError, match="positive"):
        rate_claim("r", "", q, J, polar, domain=domain, **numbers)
    with pytest.raises(ShapeError):
        rate_claim("r", "", q, ca.SX(3, 2), polar, domain=domain, **numbers)
    tenth = Fraction(1, 10)
    domain = (domain[0], Range("e", (zero, tenth), (Fraction(7), Fraction(1, 2))))
    assert (
        status(rate_claim("r", "", q, J, polar, domain=domain, **numbers)) == "PROVED"
    )


def test_shapes_are_checked():
    q, p, J = elbow()
    with pytest.raises(ShapeError):
        inward_claims("x", "", q, J, BOX)
    with pytest.raises(ShapeError):
        inward_claims("x", "", q, p, BOX[:1])
