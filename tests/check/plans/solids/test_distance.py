"""Oracle: coal; and laws that any signed distance of a convex set keeps."""

import coal
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.check.plans.solids.distance import (
    gap,
    normals,
    read_obstacle,
    signed_distance,
)
from rrnn_opt.errors import DocumentError

TURN = (np.array([1.0, 2.0, -3.0, 1.5]) / np.linalg.norm([1, 2, -3, 1.5])).tolist()
CENTRE = np.array([0.3, -0.2, 0.5])
PLACED = {"position": [0.3, -0.2, 0.5], "quat_xyzw": TURN}
OBSTACLES = {
    "box": {"type": "box", "size": [0.4, 0.6, 0.2], **PLACED},
    "thin": {"type": "box", "size": [0.002, 0.6, 0.42], **PLACED},
    "cylinder": {"type": "cylinder", "radius": 0.2, "length": 0.5, **PLACED},
    "capsule": {"type": "capsule", "radius": 0.1, "length": 0.5, **PLACED},
    "sphere": {"type": "sphere", "radius": 0.25, "position": [0.3, -0.2, 0.5]},
    "halfspace": {"type": "halfspace", "normal": [0.6, 0.0, 0.8], "offset": 0.1},
}
KINDS = list(OBSTACLES)


def coal_shape(entry):
    kind = entry["type"]
    if kind == "box":
        return coal.Box(*entry["size"])
    if kind == "cylinder":
        return coal.Cylinder(entry["radius"], entry["length"])
    if kind == "capsule":
        return coal.Capsule(entry["radius"], entry["length"])
    if kind == "sphere":
        return coal.Sphere(entry["radius"])
    return coal.Halfspace(np.array(entry["normal"]), entry["offset"])


def coal_distance(entry, point, radius):
    obstacle = read_obstacle(entry, "o")
    place = coal.Transform3s(np.eye(3), np.zeros(3))
    if entry["type"] != "halfspace":
        place = coal.Transform3s(obstacle.rotation, obstacle.position)
    result = coal.DistanceResult()
    ball = coal.Transform3s(np.eye(3), point)
    return coal.distance(
        coal.Sphere(radius),
        ball,
        coal_shape(entry),
        place,
        coal.DistanceRequest(),
        result,
    )


@pytest.mark.parametrize("name", KINDS)
def test_distances_are_coals(name):
    entry, radius = OBSTACLES[name], 0.05
    rng = np.random.default_rng(3)
    points = rng.uniform(-0.6, 0.6, (400, 3)) + CENTRE
    d = signed_distance(read_obstacle(entry, "o"), points)
    oracle = np.array([coal_distance(entry, p, radius) for p in points]) + radius
    # coal's iterative solver is exact to 1e-6; inside a solid it may say less
    outside = d > 1e-3
    assert outside.sum() > 50
    np.testing.assert_allclose(d[outside], oracle[outside], atol=2e-6)
    deep = d < -radius - 1e-3
    if entry["type"] in ("sphere", "halfspace", "capsule"):
        np.testing.assert_allclose(d[deep], oracle[deep], atol=2e-6)
    else:
        assert np.all(oracle[deep] < radius)


@pytest.mark.parametrize("name", KINDS)
def test_normals_are_gradients(name):
    obstacle = read_obstacle(OBSTACLES[name], "o")
    points = np.random.default_rng(4).uniform(-0.7, 0.7, (500, 3)) + CENTRE
    n = normals(obstacle, points)
    np.testing.assert_allclose(np.linalg.norm(n, axis=1), 1.0, atol=1e-12)
    step = 1e-6
    slopes = [
        (signed_distance(obstacle, points + e) - signed_distance(obstacle, points - e))
        / (2 * step)
        for e in step * np.eye(3)
    ]
    good = np.abs(np.stack(slopes, axis=1) - n).max(axis=1) < 1e-4
    assert good.mean() > 0.99  # a few samples straddle a medial edge


@pytest.mark.parametrize("name", KINDS)
@settings(max_examples=60, deadline=None, derandomize=True)
@given(seed=st.integers(0, 10**6))
def test_any_direction_gives_a_true_lower_bound(name, seed):
    """gap(n) <= d for every unit n, with equality at the normal outside."""
    rng = np.random.default_rng(seed)
    obstacle = read_obstacle(OBSTACLES[name], "o")
    points = rng.uniform(-1, 1, (50, 3)) + CENTRE
    d, best = signed_distance(obstacle, points), normals(obstacle, points)
    n = rng.normal(size=(50, 3))
    n /= np.linalg.norm(n, axis=1)[:, None]
    assert np.all(gap(obstacle, points, n) <= d + 1e-12)
    outside = d > 1e-9
    sharp = gap(obstacle, points, best)
    np.testing.assert_allclose(sharp[outside], d[outside], atol=1e-12)


@pytest.mark.parametrize("name", KINDS)
def test_special_points_have_a_unit_normal(name):
    obstacle = read_obstacle(OBSTACLES[name], "o")
    half = 0.25 * obstacle.rotation[:, 2]
    points = np.array(
        [obstacle.position, obstacle.position + half, obstacle.position - 2 * half]
    )
    d, n = signed_distance(obstacle, points), normals(obstacle, points)
    assert np.all(np.isfinite(d))
    np.testing.assert_allclose(np.linalg.norm(n, axis=1), 1.0, atol=1e-12)


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"size": [1, 0, 1]}, "size"),
        ({"size": [1, 1]}, "size"),
        ({"position": [0, 0, float("nan")]}, "position"),
        ({"position": ["0", 0, 0]}, "position"),
        ({"quat_xyzw": [0, 0, 0, 2]}, "quat_xyzw"),
        ({"type": "mesh"}, "path"),
        ({"type": "torus"}, "type"),
        ({"type": 3}, "type"),
    ],
)
def test_malformed_obstacles_are_refused(change, field):
    with pytest.raises(DocumentError, match=field):
        read_obstacle({**OBSTACLES["box"], **change}, "obstacles[0]")


def test_a_normal_of_wrong_length_is_refused():
    entry = {**OBSTACLES["halfspace"], "normal": [0.0, 0.0, 2.0]}
    with pytest.raises(DocumentError, match="unit length"):
        read_obstacle(entry, "obstacles[0]")
