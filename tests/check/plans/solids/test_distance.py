"""Oracle: coal; and laws that any signed distance of a convex set keeps."""

import coal
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.check.plans.solids.distance import Solids
from rrnn_opt.check.plans.solids.obstacle import read_obstacle
from rrnn_opt.errors import DocumentError
from tests.check.plans.one_solid import OneSolid

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
    d = OneSolid(entry).distance(points)
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
    solid = OneSolid(OBSTACLES[name])
    points = np.random.default_rng(4).uniform(-0.7, 0.7, (500, 3)) + CENTRE
    n = solid.normals(points)
    np.testing.assert_allclose(np.linalg.norm(n, axis=1), 1.0, atol=1e-12)
    step = 1e-6
    slopes = [
        (solid.distance(points + e) - solid.distance(points - e)) / (2 * step)
        for e in step * np.eye(3)
    ]
    good = np.abs(np.stack(slopes, axis=1) - n).max(axis=1) < 1e-4
    assert good.mean() > 0.99  # a few samples straddle a medial edge


@pytest.mark.parametrize("name", KINDS)
@settings(max_examples=60)
@given(seed=st.integers(0, 10**6))
def test_any_direction_gives_a_true_lower_bound(name, seed):
    """gap(n) <= d for every unit n, with equality at the normal outside."""
    rng = np.random.default_rng(seed)
    solid = OneSolid(OBSTACLES[name])
    points = rng.uniform(-1, 1, (50, 3)) + CENTRE
    d, best = solid.distance(points), solid.normals(points)
    n = rng.normal(size=(50, 3))
    n /= np.linalg.norm(n, axis=1)[:, None]
    assert np.all(solid.gap(points, n) <= d + 1e-12)
    outside = d > 1e-9
    sharp = solid.gap(points, best)
    np.testing.assert_allclose(sharp[outside], d[outside], atol=1e-12)


@pytest.mark.parametrize("name", KINDS)
def test_special_points_have_a_unit_normal(name):
    solid = OneSolid(OBSTACLES[name])
    obstacle = solid.obstacle
    half = 0.25 * obstacle.rotation[:, 2]
    points = np.array(
        [obstacle.position, obstacle.position + half, obstacle.position - 2 * half]
    )
    d, n = solid.distance(points), solid.normals(points)
    assert np.all(np.isfinite(d))
    np.testing.assert_allclose(np.linalg.norm(n, axis=1), 1.0, atol=1e-12)


@pytest.mark.parametrize("kind", ["box", "cylinder", "capsule", "sphere", "halfspace"])
def test_solids_side_by_side_answer_as_each_alone(kind):
    """All with all points, and each with its own, against one at a time."""
    rng, entries = np.random.default_rng(6), []
    for _ in range(7):
        q = rng.normal(size=4)
        placed = {"position": rng.uniform(-1, 1, 3).tolist()}
        placed["quat_xyzw"] = (q / np.linalg.norm(q)).tolist()
        size = {"size": rng.uniform(0.1, 0.5, 3).tolist(), "offset": rng.normal()}
        size |= {"radius": rng.uniform(0.1, 0.3), "length": rng.uniform(0.1, 0.5)}
        n = rng.normal(size=3)
        size["normal"] = (n / np.linalg.norm(n)).tolist()
        entries.append({"type": kind, **placed, **size})
    alone = [OneSolid(entry) for entry in entries]
    solids = Solids.of([one.obstacle for one in alone])
    points = rng.uniform(-1, 1, (40, 3))
    table = np.stack([one.distance(points) for one in alone])
    np.testing.assert_allclose(solids.every_distance(points.T), table, atol=1e-14)
    which = rng.integers(0, 7, 40)
    mine = table[which, np.arange(40)]
    np.testing.assert_allclose(solids.distance(points.T, which), mine, atol=1e-14)
    gap, n = solids.facing(points.T, which)
    for k, i in enumerate(which):
        at = points[k : k + 1]
        np.testing.assert_allclose(n[:, k], alone[i].normals(at)[0], atol=1e-14)
        wanted = alone[i].gap(at, alone[i].normals(at))[0]
        assert gap[k] == pytest.approx(wanted, abs=1e-14)


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
