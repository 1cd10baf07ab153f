from functools import cache

import casadi as ca
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.errors import RrnnError, ShapeError
from rrnn_opt.symbolic import Ball, Box, Orthant, Product, whole_space

LAWS = settings(max_examples=40)
N = 4
ROUND = 1e-12


def _box():
    lower = np.array([-1.0, -np.inf, 0.25, -2.0])
    upper = np.array([0.5, 1.0, np.inf, -1.0])
    return Box(lower, upper)


def _sets():
    ball = Ball(np.array([0.3, -0.2, 0.1, 0.0]), 0.7)
    small = Product((Box(np.array([-0.5]), np.array([0.0])), Orthant(1)))
    product = Product((small, Ball(np.array([1.0, 1.0]), 0.4)))
    return [_box(), ball, Orthant(N), whole_space(N), product]


IDS = ["box", "ball", "orthant", "space", "product"]
every_set = pytest.mark.parametrize("which", range(len(IDS)), ids=IDS)
points = st.lists(
    st.floats(-5.0, 5.0, allow_nan=False, width=32), min_size=N, max_size=N
).map(np.array)


@every_set
@LAWS
@given(x=points)
def test_projection_is_idempotent_and_lands_inside(which, x):
    C = _sets()[which]
    p = C.project(x)
    assert C.contains(p, tolerance=ROUND)
    np.testing.assert_allclose(C.project(p), p, atol=ROUND)


@every_set
@LAWS
@given(x=points, y=points)
def test_projection_is_firmly_nonexpansive(which, x, y):
    C = _sets()[which]
    p, r = C.project(x), C.project(y)
    assert (p - r) @ (p - r) <= (p - r) @ (x - y) + 1e-10


@every_set
@LAWS
@given(x=points, y=points)
def test_variational_inequality(which, x, y):
    C = _sets()[which]
    p, inside = C.project(x), C.project(y)
    assert (x - p) @ (inside - p) <= 1e-10


@every_set
@LAWS
@given(x=points, y=points)
def test_normal_cone_is_where_the_projection_returns(which, x, y):
    C = _sets()[which]
    p = C.project(x)
    assert C.in_normal_cone(p, x - p, tolerance=1e-10)
    inside = C.project(y)
    if (x - p) @ (inside - p) < -1e-6:  # not normal at that other point
        assert not C.in_normal_cone(inside, x - p, tolerance=1e-10)


@every_set
@LAWS
@given(x=points, y=points)
def test_support_bounds_the_set_and_is_reached(which, x, y):
    C = _sets()[which]
    value = float(C.support(y))
    assert C.project(x) @ y <= value + 1e-9
    if np.isfinite(value):
        far = C.project(1e6 * y)
        assert far @ y == pytest.approx(value, abs=1e-4)


@cache
def _compiled(which):
    C = _sets()[which]
    sx, sy = ca.SX.sym("x", N), ca.SX.sym("y", N)
    outputs = [C.project(sx), C.contains(sx), C.support(sy), C.normal_cone(sx, sy)]
    return ca.Function("f", [sx, sy], outputs)


def _flat(value):
    return np.asarray(value).ravel()


@every_set
@LAWS
@given(x=points, y=points)
def test_expression_and_array_agree(which, x, y):
    C = _sets()[which]
    p, inside, support, normal = _compiled(which)(x, y)
    np.testing.assert_allclose(_flat(p), C.project(x), atol=ROUND)
    assert bool(inside) is C.contains(x)
    np.testing.assert_allclose(float(support), float(C.support(y)), rtol=1e-12)
    np.testing.assert_allclose(_flat(normal), C.normal_cone(x, y), atol=1e-11)


def test_symbolic_sides_project_like_numbers():
    lower, upper, x = (ca.SX.sym(name, 2) for name in ("l", "u", "x"))
    project = ca.Function("p", [lower, upper, x], [Box(lower, upper).project(x)])
    assert _flat(project([-1, 0], [1, 2], [-3, 1])).tolist() == [-1.0, 1.0]


def test_an_empty_symbolic_box_projects_to_its_upper_side():
    lower, upper, x = (ca.SX.sym(name, 1) for name in ("l", "u", "x"))
    project = ca.Function("p", [lower, upper, x], [Box(lower, upper).project(x)])
    assert float(project(-0.25, -0.5, 0.0)) == -0.5


def test_infinite_sides_leave_no_operation_in_the_graph():
    x = ca.SX.sym("x", 3)
    assert ca.is_equal(whole_space(3).project(x), x)
    assert "fmin" not in str(Orthant(3).project(x))


def test_printed_inequality_20_fails_and_its_square_holds():
    # (20) as printed: |P(x) - x|^2 <= |y - x|; a counterexample with y in the set
    C = Box(np.array([2.0]), np.array([4.0]))
    x, y = np.array([0.0]), np.array([3.0])
    gap = float(np.sum((C.project(x) - x) ** 2))
    assert gap > np.linalg.norm(y - x)
    assert gap <= np.sum((y - x) ** 2)


@every_set
@pytest.mark.parametrize("shape", [(1, 1), (1, N), (N, 2), (N + 1, 1)])
def test_nothing_is_broadcast(which, shape):
    C = _sets()[which]
    for x in (ca.SX.sym("x", *shape), np.zeros(shape)):
        with pytest.raises(ShapeError):
            C.project(x)
        with pytest.raises(ShapeError):
            C.support(x)


def test_bad_sets_are_refused():
    with pytest.raises(RrnnError, match="empty"):
        Box(np.array([1.0]), np.array([0.0]))
    with pytest.raises(RrnnError, match="NaN"):
        Box(np.array([np.nan]), np.array([0.0]))
    for end in (np.inf, -np.inf):
        with pytest.raises(RrnnError, match="empty"):
            Box(np.array([end]), np.array([end]))
    with pytest.raises(ShapeError):
        Box(np.zeros(2), np.zeros(3))
    with pytest.raises(ShapeError):
        Box(ca.SX.sym("l", 1, 3), ca.SX.sym("u", 1, 3))
    with pytest.raises(RrnnError, match="positive"):
        Ball(np.zeros(2), 0.0)
