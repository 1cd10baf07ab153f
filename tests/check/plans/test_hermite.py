"""Oracles: scipy's own Hermite splines, and exact rational arithmetic."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicHermiteSpline

from rrnn_opt.check.plans import hermite

RANGES = (hermite.position_range, hermite.velocity_range, hermite.acceleration_range)


def rows(seed, n=8, nv=3, still=False):
    rng = np.random.default_rng(seed)
    t = np.concatenate([[0.0], np.cumsum(rng.uniform(0.01, 1.0, n - 1))])
    q, qd = rng.normal(size=(n, nv)), rng.normal(size=(n, nv))
    if still:
        q[:], qd[:] = q[0], 0.0
    return t, q, qd


@pytest.mark.parametrize("order", [0, 1, 2])
@pytest.mark.parametrize("seed", range(5))
def test_pieces_are_scipys(seed, order):
    t, q, qd = rows(seed)
    p = hermite.pieces(t, q, qd)
    share = np.random.default_rng(seed + 100).uniform(0, 1, len(p.h))
    s = (share * p.h)[:, None]
    ours = (
        hermite.position(p, s),
        hermite.velocity(p, s),
        2 * p.c2 + 6 * s * p.c3,
    )[order]
    oracle = CubicHermiteSpline(t, q, qd)(t[:-1] + s[:, 0], nu=order)
    np.testing.assert_allclose(ours, oracle, atol=1e-9, rtol=1e-9)


@pytest.mark.parametrize("order", [0, 1, 2])
@pytest.mark.parametrize("seed", range(20))
def test_ranges_are_those_of_dense_samples(seed, order):
    t, q, qd = rows(seed)
    low, high = RANGES[order](hermite.pieces(t, q, qd))
    spline = CubicHermiteSpline(t, q, qd)
    for i in range(len(t) - 1):
        # one point short of the end: scipy takes the next piece there
        dense = np.linspace(t[i], t[i + 1], 4001)[:-1]
        values = spline(dense, nu=order)
        assert np.all(values >= low[i] - 1e-9)
        assert np.all(values <= high[i] + 1e-9)
        # the true extreme lies within a step of some sample
        slope = np.abs(spline(dense, nu=order + 1)).max()
        miss = 1.01 * (dense[1] - dense[0]) * slope + 1e-9
        np.testing.assert_allclose(values.min(axis=0), low[i], rtol=0, atol=miss)
        np.testing.assert_allclose(values.max(axis=0), high[i], rtol=0, atol=miss)


def exact_pieces(t, q, qd):
    """Coefficients in rational arithmetic."""
    t0, t1, q0, q1, v0, v1 = map(Fraction, (t[0], t[1], q[0], q[1], qd[0], qd[1]))
    h = t1 - t0
    d = (q1 - q0) / h
    return h, q0, v0, (3 * d - 2 * v0 - v1) / h, (v0 + v1 - 2 * d) / h**2


NUMBER = st.floats(-10, 10, allow_nan=False, width=32)


@settings(max_examples=200)
@given(
    q=st.tuples(NUMBER, NUMBER),
    qd=st.tuples(NUMBER, NUMBER),
    h=st.floats(1e-4, 10.0),
    share=st.fractions(0, 1, max_denominator=97),
)
def test_every_exact_value_is_in_the_range_with_its_rounding(q, qd, h, share):
    t = (0.0, h)
    arrays = np.array(t), np.array(q)[:, None], np.array(qd)[:, None]
    p = hermite.pieces(*arrays)
    error = hermite.rounding(p)
    width, c0, c1, c2, c3 = exact_pieces(t, q, qd)
    s = share * width
    exact = (
        c0 + s * (c1 + s * (c2 + s * c3)),
        c1 + s * (2 * c2 + 3 * s * c3),
        2 * c2 + 6 * s * c3,
    )
    for k in range(3):
        low, high = RANGES[k](p)
        assert Fraction(float(low[0, 0] - error[k][0, 0])) <= exact[k]
        assert exact[k] <= Fraction(float(high[0, 0] + error[k][0, 0]))


@settings(max_examples=100)
@given(bulge=st.floats(0.01, 3.0), h=st.floats(0.01, 5.0))
def test_a_bulge_between_equal_rows_is_found(bulge, h):
    """Equal ends, speeds +v and -v: the parabola's top is v h / 4 above."""
    v = 4 * bulge / h
    p = hermite.pieces(np.array([0, h]), np.zeros((2, 1)), np.array([[v], [-v]]))
    low, high = hermite.position_range(p)
    assert high[0, 0] == pytest.approx(bulge, rel=1e-9)
    assert low[0, 0] == pytest.approx(0.0, abs=1e-12)


def test_a_still_motion_has_no_range():
    t, q, qd = rows(3, still=True)
    p = hermite.pieces(t, q, qd)
    for k, value in ((0, q[0]), (1, 0.0), (2, 0.0)):
        low, high = RANGES[k](p)
        np.testing.assert_array_equal(low, high)
        np.testing.assert_allclose(low, np.broadcast_to(value, low.shape), atol=1e-15)


def test_second_derivatives_stand_where_the_format_says():
    t, q, qd = rows(5)
    ours = hermite.second_derivatives(hermite.pieces(t, q, qd))
    spline = CubicHermiteSpline(t, q, qd)
    np.testing.assert_allclose(ours[:-1], spline(t[:-1], nu=2), rtol=1e-9, atol=1e-9)
    end = spline.c[:, -1]
    h = t[-1] - t[-2]
    np.testing.assert_allclose(ours[-1], 6 * end[0] * h + 2 * end[1], rtol=1e-9)
