"""Oracles: cubics with known extremes, and doubles outside their own rounding."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.check import certify_trajectory
from rrnn_opt.check.arithmetic import cubic
from rrnn_opt.check.plans import hermite
from rrnn_opt.motion import Trajectory

NUMBER = st.floats(-10, 10, allow_nan=False, width=32)


@settings(max_examples=200)
@given(
    q=st.tuples(NUMBER, NUMBER),
    qd=st.tuples(NUMBER, NUMBER),
    h=st.floats(1e-3, 10.0),
    kind=st.sampled_from(["position", "velocity", "acceleration"]),
)
def test_rationals_and_doubles_agree_outside_the_rounding(q, qd, h, kind):
    """Just above the float maximum it is kept, just below it is not."""
    order = cubic.ORDERS[kind]
    rows = np.array([0.0, h]), np.array(q)[:, None], np.array(qd)[:, None]
    p = hermite.pieces(*rows)
    ranges = hermite.position_range, hermite.velocity_range, hermite.acceleration_range
    most = float(ranges[order](p)[1][0, 0])
    room = float(hermite.rounding(p)[order][0, 0]) + 1e-300
    assert cubic.keeps(kind, (0.0, h), q, qd, most + room)
    assert not cubic.keeps(kind, (0.0, h), q, qd, most - room)


@settings(max_examples=100)
@given(top=st.integers(-20, 20), at=st.integers(1, 7), steep=st.integers(1, 9))
def test_a_position_that_touches_its_limit_is_kept_and_one_ulp_less_is_not(
    top, at, steep
):
    """q = top - steep (x - r)^2 (x + 1), r = at / 8: touches top inside, exactly."""
    r = Fraction(at, 8)

    def q(x):
        return top - steep * (x - r) ** 2 * (x + 1)

    def qd(x):
        return -steep * (2 * (x - r) * (x + 1) + (x - r) ** 2)

    rows = (
        (0.0, 1.0),
        tuple(map(float, (q(0), q(1)))),
        tuple(map(float, (qd(0), qd(1)))),
    )
    assert [Fraction(x) for x in (*rows[1], *rows[2])] == [q(0), q(1), qd(0), qd(1)]
    assert cubic.keeps("position", *rows, float(top))
    assert not cubic.keeps("position", *rows, float(np.nextafter(top, -np.inf)))


def test_a_velocity_is_exact_at_its_vertex():
    """Rest to rest over one unit in one second peaks at 1.5 exactly."""
    rows = (0.0, 1.0), (0.0, 1.0), (0.0, 0.0)
    assert cubic.keeps("velocity", *rows, 1.5)
    assert not cubic.keeps("velocity", *rows, float(np.nextafter(1.5, 0)))
    assert cubic.keeps("acceleration", *rows, 6.0)
    assert not cubic.keeps("acceleration", *rows, float(np.nextafter(6.0, 0)))


@pytest.mark.parametrize(("steps", "verdict"), [(0, "PROVED"), (-1, "REFUTED")])
def test_a_certificate_decides_to_the_last_bit(planar, steps, verdict):
    """The velocity limit, tolerance included, is the peak or one ulp below it."""
    rows = Trajectory.from_rows([0.0, 1.0], [[0.0, 0.0], [1.0, 0.0]], np.zeros((2, 2)))
    limit = 1.5 / (1 + 1e-9)
    while limit + 1e-9 * limit < 1.5:
        limit = float(np.nextafter(limit, 2.0))
    while limit + 1e-9 * limit > 1.5:
        limit = float(np.nextafter(limit, 0.0))
    assert limit + 1e-9 * limit == 1.5
    if steps:
        limit = float(np.nextafter(np.nextafter(limit, 0), 0))
    planar["limits"]["velocity"] = [limit, 2.0]
    found = certify_trajectory(planar, {}, rows.to_dict())
    assert found.limits == verdict
