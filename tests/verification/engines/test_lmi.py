"""Decay rates of frozen networks: found, proved exactly, refuted."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from rrnn_opt.decay import DecayClaim, corner_matrices, exact_matrix
from rrnn_opt.errors import RrnnError, ShapeError
from rrnn_opt.verification import certify, verdict_row

J = [Fraction(n, 12) for n in (12, -6, 3, 4, 12, 6)]


def network(*entries):
    """x' = A x of network (6) in the interior, W = I/2, J 2 x 3, unit of time eps."""
    rows = [[Fraction(0)] * 5 for _ in range(5)]
    for k in range(3):
        rows[k][k] = Fraction(-1)
        for r in range(2):
            rows[k][3 + r] = entries[3 * r + k]
            rows[3 + r][k] = -entries[3 * r + k]
    return rows


def claim(rate, *vertices, **more):
    return DecayClaim("T", "test", "words", vertices, Fraction(rate), **more)


def test_the_frozen_network_decays():
    frozen = exact_matrix(network(*J))
    verdict = certify(claim("1/5", frozen))
    assert (verdict.status, verdict.trust, verdict.engine) == ("PROVED", "exact", "lmi")
    assert verdict_row(claim("1/5", frozen), verdict)["verdict"] == "PROVED"
    slowest = -np.max(np.linalg.eigvals(np.array(frozen, dtype=float)).real)
    faster = Fraction(slowest) + Fraction(1, 1000)
    assert certify(claim(faster, frozen)).status == "REFUTED"


def test_a_box_of_jacobians_has_one_function():
    width = Fraction(1, 20)
    vertices = corner_matrices(network, [(x - width, x + width) for x in J])
    assert len(vertices) == 64
    verdict = certify(claim("1/10", *vertices))
    assert verdict.status == "PROVED"
    assert "64 vertices" in verdict.reason


def test_what_no_quadratic_function_shows_is_unknown():
    """Both vertices are stable; switching between them is not."""
    one, two = [[-1, 10], [-0.1, -1]], [[-1, 0.1], [-10, -1]]
    verdict = certify(claim("1/2", exact_matrix(one), exact_matrix(two)))
    assert verdict.status == "UNKNOWN"
    assert "no quadratic function" in verdict.reason


def test_floats_are_the_fractions_that_they_are():
    rows = [[-1.0, 0.1], [0.0, -2.0]]
    plain = DecayClaim("T", "test", "words", (np.array(rows),), 0.25)
    assert plain.vertices == (exact_matrix(rows),)
    assert plain.fingerprint == claim("1/4", exact_matrix(rows)).fingerprint
    assert certify(plain).status == "PROVED"
    for bad in ("one", [["a"]], [[float("nan")]], [1.0]):
        with pytest.raises(RrnnError, match="rows of finite numbers"):
            claim("1/4", bad)


def test_discrete_steps():
    step = exact_matrix([[0.5, 0.25], [0.0, 0.5]])
    assert certify(claim("3/5", step, discrete=True)).status == "PROVED"
    assert certify(claim("2/5", step, discrete=True)).status == "REFUTED"


@pytest.mark.parametrize(
    ("make", "error"),
    [
        (lambda: claim(1), RrnnError),
        (lambda: claim(-1, exact_matrix([[1]])), RrnnError),
        (lambda: claim(2, exact_matrix([[1]]), discrete=True), RrnnError),
        (lambda: claim(1, exact_matrix([[1, 2]])), ShapeError),
        (lambda: claim(1, exact_matrix([[1]]), exact_matrix([[1, 0], [0, 1]])),
         ShapeError),
        (lambda: exact_matrix([[np.nan]]), RrnnError),
        (lambda: certify(claim(1, exact_matrix([[-2]])), witnesses=({"x": [1]},)),
         RrnnError),
    ],
)  # fmt: skip
def test_bad_input_is_named(make, error):
    with pytest.raises(error):
        make()
