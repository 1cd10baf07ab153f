"""Identities of products and of squares: what they settle, and that it is exact."""

from __future__ import annotations

import os
from fractions import Fraction

import casadi as ca
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.check.claims.certificate import check_certificate
from rrnn_opt.claim import Claim, Hypothesis, Range, Relation
from rrnn_opt.robot import Kinematics, Robot
from rrnn_opt.symbolic import Symbol
from rrnn_opt.verification import certify
from rrnn_opt.verification.engines.squares.kernel import complement

X, Y = Symbol.scalar("x"), Symbol.scalar("y")
x, y = X.sx, Y.sx
SLOW = pytest.mark.slow
HERE = Range("x", (Fraction(-1),), (Fraction(1, 3),))


def claim(expression, sense=">=0", variables=(X, Y), **more):
    return Claim("T", "", "", variables, Relation(expression, sense), **more)


def settled(stated, engine):
    verdict = certify(stated, engines=(engine,))
    if verdict.certificate is not None:
        assert check_certificate(verdict.certificate).holds
    return verdict


def projected(size):
    """x, a box that holds 0, and the projection of x onto it."""
    names = ("x", "low", "high")
    v, low, high = symbols = tuple(Symbol.vector(name, size) for name in names)
    box = (
        Range("low", (None,) * size, (Fraction(0),) * size),
        Range("high", (Fraction(0),) * size, (None,) * size),
    )
    return symbols, ca.fmin(ca.fmax(v.sx, low.sx), high.sx), box


@pytest.mark.parametrize("size", [1, 2, pytest.param(7, marks=SLOW)])
def test_the_projection_lemma_of_any_number_of_joints_is_exact(size):
    """x'P(x) >= |P(x)|^2 when 0 is in the box, eq. (21) and more."""
    variables, p, box = projected(size)
    excess = ca.dot(variables[0].sx, p) - ca.sumsqr(p)
    verdict = settled(claim(excess, ">=0", variables, domain=box), "products")
    assert (verdict.status, verdict.trust) == ("PROVED", "exact")
    wider = claim(excess, ">=0", variables)  # 0 need not be in the box
    assert settled(wider, "products").status == "UNKNOWN"


NAMES = ("q", "low", "high", "c", "v_low", "v_high", "u", "h")
Q, LOW, HIGH, C, V_LOW, V_HIGH, U, H = PARTS = tuple(map(Symbol.scalar, NAMES))
BELOW = [(n, "", Relation(e, ">=0")) for n, e in (
    ("A1", Q.sx - LOW.sx), ("A2", HIGH.sx - Q.sx), ("A3", C.sx), ("A4", H.sx),
    ("A5", -V_LOW.sx), ("A6", V_HIGH.sx),
)]  # fmt: skip
LOWER = ca.fmax(C.sx * (LOW.sx - Q.sx), V_LOW.sx)
UPPER = ca.fmin(C.sx * (HIGH.sx - Q.sx), V_HIGH.sx)
STEPPED = Q.sx + H.sx * ca.fmin(ca.fmax(U.sx, LOWER), UPPER)


@pytest.mark.parametrize(
    ("goal", "step", "status"),
    [
        (ca.vertcat(UPPER - LOWER, UPPER, -LOWER), 1, "PROVED"),  # (10) holds 0
        (ca.vertcat(HIGH.sx - STEPPED, STEPPED - LOW.sx), 1, "PROVED"),
        (ca.vertcat(HIGH.sx - STEPPED, STEPPED - LOW.sx), 1.25, "UNKNOWN"),
    ],
)
def test_limits_of_a_joint_by_cases(goal, step, status):
    """Velocity bounds (10), and a joint stays within limits iff h c <= 1."""
    given_ = tuple(Hypothesis(*row) for row in BELOW)
    short = Hypothesis("A7", "short steps", Relation(step - H.sx * C.sx, ">=0"))
    stated = claim(goal, ">=0", PARTS, hypotheses=(*given_, short))
    verdict = settled(stated, "products")
    assert verdict.status == status
    assert verdict.trust == ("exact" if status == "PROVED" else None)
    if status == "UNKNOWN":
        assert certify(stated, engines=("falsifier", "smt")).status == "REFUTED"


@pytest.mark.parametrize(
    ("expression", "sense", "engine", "status"),
    [
        ((x + 1) * (1 - 3 * x), ">=0", "products", "PROVED"),
        ((x + 1) * (1 - 3 * x), ">0", "products", "UNKNOWN"),
        ((x + 1) * (1 - 3 * x) + 0.125, ">0", "products", "PROVED"),
        (ca.fmin(x, 1) - x, "==0", "products", "UNKNOWN"),
        (x**2 - x * y + y**2, ">=0", "sos", "PROVED"),
        (-(x**2) + x * y - y**2 - 0.5, "<0", "sos", "PROVED"),
        pytest.param(x**2 - x * y + y**2, ">0", "sos", "UNKNOWN", marks=SLOW),
        (2 - ca.sin(y) - ca.cos(y) ** 2, ">=0", "sos", "PROVED"),
        pytest.param(
            1.25 - ca.sin(y) - ca.cos(y) ** 2 - 1e-3,
            ">=0",
            "sos",
            "UNKNOWN",
            marks=SLOW,
        ),
        pytest.param(
            x**2 - 2 * x * y + 0.999 * y**2, ">=0", "sos", "UNKNOWN", marks=SLOW
        ),
    ],
)
def test_verdicts(expression, sense, engine, status):
    verdict = settled(claim(expression, sense, domain=(HERE,)), engine)
    assert verdict.status == status, verdict.reason


def test_zeros_are_split_off():
    """(x y - 1)^2 (1 + x^2) vanishes on a curve; no matrix of it is definite."""
    verdict = settled(claim((x * y - 1) ** 2 * (1 + x**2)), "sos")
    assert (verdict.status, verdict.trust) == ("PROVED", "exact")


@pytest.mark.slow
def test_motzkins_polynomial_is_no_sum_of_squares():
    motzkin = x**4 * y**2 + x**2 * y**4 - 3 * x**2 * y**2 + 1
    assert settled(claim(motzkin), "sos").status == "UNKNOWN"


def conditioned(bound):
    """lambda_min(JJ') >= bound on the planar arm wherever sin q2 >= 1/2."""
    q = Symbol.vector("q", 3)
    arm = Kinematics(Robot.builtin("planar3"))
    jacobian = ca.substitute(arm.jacobian("tip")[:2, :], arm.q, q.sx)
    m = jacobian @ jacobian.T - bound * ca.SX.eye(2)
    bent = Hypothesis("A1", "elbow bent", Relation(ca.sin(q.sx[1]) - 0.5, ">=0"))
    sylvester = ca.vertcat(m[0, 0] + m[1, 1], m[0, 0] * m[1, 1] - m[0, 1] * m[1, 0])
    return claim(sylvester, ">=0", (q,), hypotheses=(bent,))


def worked():
    """CPU seconds of this process and of the solvers that it ran."""
    return sum(os.times()[:4])


def test_the_planar_arm_is_well_conditioned_at_every_configuration():
    """All q1 and q3; the least eigenvalue that samples find is 0.0350863."""
    begin = worked()
    verdict = settled(conditioned(0.03), "sos")
    found = worked() - begin
    assert (verdict.status, verdict.trust) == ("PROVED", "exact")
    begin = worked()
    check_certificate(verdict.certificate)
    assert worked() - begin < found / 10


@pytest.mark.slow
def test_bounds_close_to_the_true_one():
    assert settled(conditioned(0.035), "sos").status == "PROVED"
    assert (
        certify(conditioned(0.0352), engines=("falsifier", "sos")).status == "REFUTED"
    )
    assert settled(conditioned(0.0352), "sos").status == "UNKNOWN"


def test_kernels_are_written_in_small_rationals():
    vector = np.array([1.0, -0.5, 2.0])
    gram = np.eye(3) - np.outer(vector, vector) / (vector @ vector)
    rows = complement(gram)
    assert len(rows) == 2
    for row in rows:
        assert row[0] * 2 - row[1] + row[2] * 4 == 0
    assert complement(np.eye(3)) is None
    odd = np.array([1.0, np.sqrt(2), 0.0])
    assert complement(np.eye(3) - np.outer(odd, odd) / (odd @ odd)) is None


coefficients = st.lists(st.integers(-3, 3), min_size=6, max_size=6)


@settings(max_examples=30)
@given(coefficients)
def test_quadratic_forms_are_judged_as_by_their_eigenvalues(c):
    a, b, d, e, f, g = c
    form = a * x**2 + b * x * y + d * y**2 + e * x + f * y + g
    matrix = np.array([[2 * a, b, e], [b, 2 * d, f], [e, f, 2 * g]])
    least = np.linalg.eigvalsh(matrix)[0]
    if ca.SX(form).is_constant():
        return
    status = settled(claim(form), "products").status
    assert status in ("PROVED", "UNKNOWN")
    if least < -1e-9:
        assert status == "UNKNOWN"
