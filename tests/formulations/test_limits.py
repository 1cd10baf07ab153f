import casadi as ca
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.errors import RrnnError, ShapeError
from rrnn_opt.formulations.limits import velocity_bounds
from rrnn_opt.robot import Limits

LAWS = settings(max_examples=60)
LIMITS = Limits(
    lower=np.array([-1.0, -np.inf, 0.2]),
    upper=np.array([2.0, np.inf, 0.4]),
    velocity=np.array([0.5, 1.5, 3.0]),
    acceleration=np.ones(3),
)


def bounds(q, **gains):
    symbol = ca.SX.sym("q", 3)
    f = ca.Function("f", [symbol], [*velocity_bounds(symbol, LIMITS, **gains)])
    return tuple(np.asarray(side).ravel() for side in f(q))


@LAWS
@given(st.lists(st.floats(0, 1), min_size=3, max_size=3).map(np.array))
def test_equation_10_inside(share):
    q = np.array([-1.0 + 3 * share[0], 20 * share[1] - 10, 0.2 + 0.2 * share[2]])
    q = np.clip(q, LIMITS.lower, LIMITS.upper)
    low, high = bounds(q, c1=0.7, c2=0.9)
    w = LIMITS.velocity
    np.testing.assert_allclose(low, np.maximum(-0.7 * (q - LIMITS.lower), -w))
    np.testing.assert_allclose(high, np.minimum(-0.9 * (q - LIMITS.upper), w))
    assert np.all(low <= 0)
    assert np.all(high >= 0)


def test_a_joint_without_limits_keeps_its_speed_and_no_operation():
    q = ca.SX.sym("q", 3)
    low, high = velocity_bounds(q, LIMITS)
    assert (float(low[1]), float(high[1])) == (-1.5, 1.5)


def test_outside_the_box_first_leads_back_then_is_empty():
    low, high = bounds(np.array([2.5, 0.0, 0.3]))
    assert low[0] < high[0] < 0  # only velocities back
    low, high = bounds(np.array([3.5, 0.0, 0.3]))
    assert low[0] > high[0]  # q - q+ > w/c2: empty


def test_the_printed_witness_of_an_empty_box():
    # q+ = -1/2, q- = -1, q = 0, c = 1, w- = -1/4: d- = -1/4 > d+ = -1/2
    limits = Limits(*(np.array([x]) for x in (-1.0, -0.5, 0.25, 1.0)))
    q = ca.SX.sym("q")
    f = ca.Function("f", [q], [*velocity_bounds(q, limits, c1=1.0, c2=1.0)])
    assert [float(x) for x in f(0)] == [-0.25, -0.5]


@pytest.mark.parametrize("shape", [(1, 1), (1, 3), (2, 1)])
def test_nothing_is_broadcast(shape):
    with pytest.raises(ShapeError, match="q: expected"):
        velocity_bounds(ca.SX.sym("q", *shape), LIMITS)


@pytest.mark.parametrize("gains", [{"c1": 0.0}, {"c2": -1.0}, {"c1": np.nan}])
def test_gains_are_positive(gains):
    with pytest.raises(RrnnError, match="must be positive"):
        velocity_bounds(ca.SX.sym("q", 3), LIMITS, **gains)
