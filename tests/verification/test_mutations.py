"""Statements that are false, most by a hair: none may be proved."""

from __future__ import annotations

from fractions import Fraction

import casadi as ca
import pytest

from rrnn_opt.claim import Range
from rrnn_opt.symbolic import Symbol
from rrnn_opt.validation.claims import case
from rrnn_opt.verification import settle
from rrnn_opt.verification.vocabulary import not_negative
from tests.verification.falsehoods import MUTATIONS, PLANAR, c, h, make, x

QUICK = {
    "0 outside the box", "W = 0", "unsquared (20)", "sign-flipped dual",
    "Euler with h c = 5/4", "singular Jacobian", "obstacle sign set of C26",
    "Euler with h = 2.5 epsilon", "V along the second-order law", "J transposed",
    "a column of J dropped", "first integral with a plus",
    "pain decays", "no miss in finite time", "total off by 0.01", "a negative factor",
    "every quadratic cost is convex", "a factor of unknown sign",
    "the proof of another claim", "a square that is not one", "inputs up to 2",
    "Euler of the memory cell, h = 1", "growth in steps", "a false lemma",
}  # fmt: skip
"""Refuted or refused without a solver."""


def names():
    slow = pytest.mark.slow
    return [pytest.param(n, marks=() if n in QUICK else slow) for n in MUTATIONS]


@pytest.mark.parametrize("name", names())
def test_what_is_false_is_never_proved(name):
    statement = MUTATIONS[name]()
    verdict = settle(statement)
    assert verdict.status in ("REFUTED", "UNKNOWN"), verdict.certificate


def test_there_are_enough_of_them():
    assert len(MUTATIONS) >= 27
    assert set(MUTATIONS) >= QUICK


@pytest.mark.parametrize("name", ["C19", "C26", "C30", "C34"])
def test_some_are_refuted_by_a_point_that_is_replayed(name):
    settled = case(name, PLANAR).settle()
    assert settled.verdict.status == "REFUTED"
    assert settled.verdict.witness
    assert settled.caught


def test_limits_are_not_kept_by_a_scheme_that_ignores_them():
    """A bound that does not depend on q cannot hold a joint back."""
    q = Symbol("q", PLANAR.q)
    limits = PLANAR.robot.limits
    room = 0.5 * (ca.DM(limits.upper) - q.sx) - ca.DM(limits.velocity)
    ranges = Range("q", *(tuple(map(Fraction, side.tolist())) for side in
                          (limits.lower, limits.upper)))  # fmt: skip
    assert settle(make(room, ">=0", (q,), domain=(ranges,))).status == "REFUTED"


def test_unused_words_do_not_help():
    claim = make(x.sx, ">=0", (x,), domain=not_negative(x))
    assert settle(claim).status == "PROVED"
    wrong = make(x.sx - 1, ">=0", (x,), domain=not_negative(x))
    assert settle(wrong).status == "REFUTED"
    assert settle(make(h.sx * c.sx, ">=0", (h, c))).status == "REFUTED"
