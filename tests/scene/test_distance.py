"""Distances and normals: coal, support functions and finite differences."""

import itertools

import casadi as ca
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.errors import ShapeError
from rrnn_opt.scene import (
    KINDS,
    PRIMITIVES,
    Box,
    Cylinder,
)
from tests.scene.solids import (
    FUNCTIONS,
    a_shape,
    coal_distance,
    evaluate,
    points_around,
    special_points,
    support,
)

ALLOWED = {
    "input", "output", "const", "add", "sub", "mul", "div", "neg", "sq", "sqrt",
    "fmin", "fmax", "fabs", "lt", "le", "not", "if_else_zero", "twice",
}  # fmt: skip


@pytest.mark.parametrize("draws", [300, pytest.param(2000, marks=pytest.mark.slow)])
@pytest.mark.parametrize("kind", KINDS)
def test_agrees_with_coal(kind, draws):
    rng = np.random.default_rng(5)
    inside = 0
    for _ in range(draws):
        shape = a_shape(kind, rng)
        p, radius = points_around(shape, rng), rng.uniform(0.005, 0.3)
        d, n = evaluate(shape, p)
        inside += d < 0
        if d < 0 and kind == "cylinder":
            # coal 3.0.3 measures to the mantle here even where an end is nearer;
            # the law of the inscribed ball below judges these points
            continue
        d_coal, n_coal = coal_distance(shape, p, radius)
        assert d - radius == pytest.approx(d_coal, abs=1e-12), shape.to_dict()
        if d > 1e-3:
            assert np.allclose(n, n_coal, atol=1e-9), shape.to_dict()
    assert 0.15 < inside / draws < 0.85


@pytest.mark.parametrize("kind", [k for k in KINDS if k != "halfspace"])
def test_inside_the_largest_ball_that_fits_touches_along_the_normal(kind):
    rng = np.random.default_rng(8)
    inside = 0
    for _ in range(400):
        shape = a_shape(kind, rng)
        p = points_around(shape, rng)
        d, n = evaluate(shape, p)
        if d >= 0:
            continue
        inside += 1
        assert support(shape, n) - n @ p == pytest.approx(-d, abs=1e-12)
        others = rng.normal(size=(50, 3))
        others = [*(o / np.linalg.norm(o) for o in others), *shape.rotation.T]
        for sign, u in itertools.product((-1, 1), others):
            assert support(shape, sign * u) - sign * u @ p >= -d - 1e-12
    assert inside > 50


@pytest.mark.parametrize("kind", KINDS)
def test_nearest_point_is_on_the_surface_and_normal_is_the_gradient(kind):
    rng = np.random.default_rng(6)
    for _ in range(200):
        shape = a_shape(kind, rng)
        p = points_around(shape, rng)
        d, n = evaluate(shape, p)
        assert evaluate(shape, p - d * n)[0] == pytest.approx(0, abs=1e-12)
        if d < 0.01:  # at the ridge inside, the distance has a kink
            continue
        h = 1e-6 * np.eye(3)
        slope = [evaluate(shape, p + e)[0] - evaluate(shape, p - e)[0] for e in h]
        assert np.allclose(np.array(slope) / 2e-6, n, atol=2e-4)


@settings(max_examples=200)
@given(
    kind=st.sampled_from([k for k in KINDS if k != "halfspace"]),
    seed=st.integers(0, 10**6),
    p=st.lists(st.floats(-3, 3), min_size=3, max_size=3),
)
def test_solid_lies_behind_the_supporting_plane(kind, seed, p):
    shape, p = a_shape(kind, np.random.default_rng(seed)), np.array(p)
    d, n = evaluate(shape, p)
    assert np.linalg.norm(n) == pytest.approx(1, abs=1e-12)
    if d >= 0:
        assert support(shape, n) - n @ p <= -d + 1e-12


@pytest.mark.parametrize("kind", KINDS)
def test_defined_at_centres_axes_faces_edges_and_corners(kind):
    rng = np.random.default_rng(7)
    shapes = [a_shape(kind, rng) for _ in range(2)]
    if kind not in ("sphere", "halfspace"):
        shapes.append(upright(shapes[0]))
    for shape in shapes:
        for p in special_points(shape):
            d, n = evaluate(shape, p)
            assert np.isfinite(d)
            assert np.linalg.norm(n) == pytest.approx(1, abs=1e-12)
            if d >= 0 and kind != "halfspace":
                assert support(shape, n) - n @ p <= -d + 1e-12


def upright(shape):
    """The shape at the origin and unrotated: local points stay exact."""
    dims = {
        k: v for k, v in shape.to_dict().items() if k in ("size", "radius", "length")
    }
    return type(shape)(name="o", **dims)


def test_a_touching_sphere_is_pushed_out_of_the_face_it_touches():
    shape = Box("o", [2, 4, 6])
    assert evaluate(shape, [0, 2, 1]) == (0, pytest.approx([0, 1, 0]))
    assert evaluate(shape, [0, 2 + 1e-19, 1])[1] == pytest.approx([0, 1, 0])
    assert evaluate(shape, [0, 0, -2.9]) == (
        pytest.approx(-0.1),
        pytest.approx([0, 0, -1]),
    )
    assert evaluate(shape, [1 + 3e-9, 2 + 4e-9, 0]) == (
        pytest.approx(5e-9, rel=1e-6),
        pytest.approx([0.6, 0.8, 0], abs=1e-6),
    )


def test_inside_the_nearest_face_wins():
    shape = Cylinder("o", 0.5, 2.0)
    assert evaluate(shape, [0.4, 0, 0]) == (
        pytest.approx(-0.1),
        pytest.approx([1, 0, 0]),
    )
    assert evaluate(shape, [0.1, 0, -0.9]) == (
        pytest.approx(-0.1),
        pytest.approx([0, 0, -1]),
    )


@pytest.mark.parametrize("kind", KINDS)
def test_only_operations_that_every_reader_knows(kind):
    names = {getattr(ca, n): n[3:].lower() for n in dir(ca) if n.startswith("OP_")}
    fn = FUNCTIONS[kind]
    used = {names[fn.instruction_id(k)] for k in range(fn.n_instructions())}
    assert used <= ALLOWED
    assert fn.sparsity_out(0).is_dense()
    assert fn.sparsity_out(1).is_dense()
    assert (fn.name_in(), fn.name_out()) == (["p", "shape"], ["d", "n"])


@pytest.mark.parametrize("kind", KINDS)
def test_shapes_of_the_arguments_are_checked(kind):
    with pytest.raises(ShapeError, match="p: expected"):
        PRIMITIVES[kind](ca.SX.sym("p", 1, 3), ca.SX.sym("s", 16))
    with pytest.raises(ShapeError, match="shape: expected"):
        PRIMITIVES[kind](ca.SX.sym("p", 3), ca.SX.sym("s", 15))


def test_primitives_stand_in_the_fixed_order():
    assert tuple(PRIMITIVES) == KINDS
    assert KINDS == ("box", "cylinder", "capsule", "sphere", "halfspace")
