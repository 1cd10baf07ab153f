"""Limits of a motion, against the extremes that scipy finds of the same spline."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import CubicHermiteSpline

from rrnn_opt.check.plans.limits import prove_limits
from rrnn_opt.check.plans.motion import Motion

KINDS = ("position", "velocity", "acceleration")


def rows(seed, n=5, nv=3):
    rng = np.random.default_rng(seed)
    t = np.cumsum(rng.uniform(0.2, 1.5, n))
    return t - t[0], rng.uniform(-2.0, 2.0, (n, nv)), rng.uniform(-3.0, 3.0, (n, nv))


def reached(line, length):
    """Least and greatest value of a polynomial on [0, length]."""
    turns = [r.real for r in line.deriv().roots if abs(r.imag) < 1e-12]
    values = line(np.array([0.0, length, *(r for r in turns if 0.0 < r < length)]))
    return values.min(), values.max()


def extremes(t, q, qd):
    """(least, greatest) of each coordinate by kind, (nv, 2), from scipy's pieces."""
    spline, found = CubicHermiteSpline(t, q, qd), {}
    for order, kind in enumerate(KINDS):
        pieces = [
            [reached(np.poly1d(c).deriv(order), length) for c in spline.c[:, i].T]
            for i, length in enumerate(np.diff(t))
        ]
        low, high = np.moveaxis(np.array(pieces), -1, 0)
        found[kind] = np.stack([low.min(axis=0), high.max(axis=0)], axis=1)
    return found


def wide(nv):
    return {
        "lower": np.full(nv, -1e3),
        "upper": np.full(nv, 1e3),
        "velocity": np.full(nv, 1e3),
        "acceleration": np.full(nv, 1e4),
    }


def squeezed(found, kind, k, side, share):
    """Wide limits but for one, at ``share`` beyond what the motion does."""
    limits, (least, most) = wide(len(found[kind])), found[kind][k]
    reached = most if side > 0 else least
    if kind == "position":
        limits["upper" if side > 0 else "lower"][k] = reached + side * share
    else:
        limits[kind][k] = max(abs(least), abs(most)) + share
    return SimpleNamespace(**limits)


@given(
    seed=st.integers(0, 10_000),
    kind=st.sampled_from(KINDS),
    k=st.integers(0, 2),
    side=st.sampled_from((-1, 1)),
    exact=st.booleans(),
)
def test_a_limit_is_kept_or_broken_by_a_hair(seed, kind, k, side, exact):
    t, q, qd = rows(seed)
    found, motion = extremes(t, q, qd), Motion.of(t, q, qd)
    kept = squeezed(found, kind, k, side, 1e-6)
    assert prove_limits(kept, motion, exact=exact) == ("PROVED", None)
    broken = squeezed(found, kind, k, side, -1e-6)
    verdict, witness = prove_limits(broken, motion, exact=exact)
    assert verdict == "REFUTED"
    assert (witness["kind"], witness["coordinate"]) == (kind, k)
    assert witness["time"] in t[:-1]
    if kind == "position":
        assert np.sign(witness["value"] - witness["limit"]) == side
        assert witness["value"] == pytest.approx(found[kind][k][(side + 1) // 2])
    assert abs(witness["value"] - witness["limit"]) == pytest.approx(1e-6, abs=1e-9)


def test_a_joint_without_position_limits_has_none():
    t, q, qd = rows(1)
    limits = wide(3) | {"lower": np.full(3, -np.inf), "upper": np.full(3, np.inf)}
    assert prove_limits(SimpleNamespace(**limits), Motion.of(t, q, qd))[0] == "PROVED"


def test_the_tolerance_is_relative_and_no_more():
    """At rest on 3 rad: 1 + 1e-9 of it is what the document says."""
    t, q = np.array([0.0, 1.0]), np.full((2, 1), 3.0)
    motion = Motion.of(t, q, np.zeros((2, 1)))
    for upper, verdict in ((3.0 - 2.9e-9, "PROVED"), (3.0 - 3.2e-9, "REFUTED")):
        limits = wide(1) | {"upper": np.array([upper])}
        assert prove_limits(SimpleNamespace(**limits), motion)[0] == verdict
