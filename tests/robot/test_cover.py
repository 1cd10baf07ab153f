import numpy as np
import pytest

from rrnn_opt.robot.cover import cover_box, cover_capsule, cover_cylinder


def _directions(count, seed=0):
    raw = np.random.default_rng(seed).normal(size=(count, 3))
    return raw / np.linalg.norm(raw, axis=1, keepdims=True)


def _outside(points, cover):
    """Largest distance of a point to the union of the spheres (<= 0: inside)."""
    gaps = np.linalg.norm(points[:, None] - cover.centers[None], axis=2)
    return float(np.max(np.min(gaps, axis=1) - cover.radius))


def _surface(cover, count=1000):
    """Points on the spheres of a cover."""
    return (cover.centers[:, None] + cover.radius * _directions(count)).reshape(-1, 3)


def _capsule_points(a, b, radius):
    share = np.linspace(0, 1, 200)[:, None, None]
    axis = a + share * (b - a)
    return (axis + radius * _directions(300)).reshape(-1, 3)


def _segment_distance(points, a, b):
    along = np.clip((points - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
    return np.linalg.norm(points - a - along[:, None] * (b - a), axis=1)


@pytest.mark.parametrize(
    ("a", "b", "radius", "inflation"),
    [
        ((0, 0, 0.08), (0, 0, 0.317), 0.09, 2e-3),
        ((0, 0, 0), (0, 0, 0.07), 0.045, 2e-3),
        ((0.1, -0.2, 0.3), (0.5, 0.4, 0.2), 0.03, 1e-3),
        ((0, 0, 0), (1.0, 0, 0), 0.04, 1e-2),
        ((0, 0, 0), (0.01, 0, 0), 0.04, 1e-2),
    ],
)
def test_capsule_is_inside_and_the_spheres_are_near(a, b, radius, inflation):
    a, b = np.array(a, dtype=float), np.array(b, dtype=float)
    cover = cover_capsule(a, b, radius=radius, inflation=inflation)
    assert cover.inflation <= inflation + 1e-11
    assert _outside(_capsule_points(a, b, radius), cover) <= 0.0
    excess = _segment_distance(_surface(cover), a, b) - radius
    assert np.max(excess) <= cover.inflation + 1e-12
    tighter = type(cover)(cover.centers, cover.radius - 2e-5, 0.0)
    assert _outside(_capsule_points(a, b, radius), tighter) > 0.0


def test_capsule_without_length_is_a_sphere():
    cover = cover_capsule((1, 2, 3), (1, 2, 3), radius=0.5)
    assert cover.centers.tolist() == [[1, 2, 3]]
    assert cover.radius == pytest.approx(0.5, abs=1e-11)


@pytest.mark.parametrize(("radius", "length"), [(0.05, 0.4), (0.1, 0.02), (0.03, 0.06)])
def test_cylinder_is_inside(radius, length):
    cover = cover_cylinder(radius, length, inflation=0.005)
    turn = np.linspace(0, 2 * np.pi, 90)
    heights = np.linspace(-length / 2, length / 2, 801)
    ring = np.stack([radius * np.cos(turn), radius * np.sin(turn), 0 * turn], axis=1)
    points = (ring[None] + heights[:, None, None] * np.array([0, 0, 1])).reshape(-1, 3)
    assert _outside(points, cover) <= 1e-15
    discs = np.concatenate([s * points[:90] for s in np.linspace(0, 1, 20)])
    discs[:, 2] = length / 2
    assert _outside(discs, cover) <= 1e-15
    surface = _surface(cover)
    outward = np.maximum(np.linalg.norm(surface[:, :2], axis=1) - radius, 0)
    above = np.maximum(np.abs(surface[:, 2]) - length / 2, 0)
    assert np.max(np.hypot(outward, above)) <= cover.inflation + 1e-12
    assert outward.max() <= 0.005 + 1e-9


@pytest.mark.parametrize("size", [(0.1, 0.2, 0.3), (0.01, 0.4, 0.2), (0.05,) * 3])
def test_box_is_inside(size):
    cover = cover_box(size, inflation=0.02)
    assert len(cover.centers) <= 64
    grid = np.stack(np.meshgrid(*[np.linspace(-0.5, 0.5, 31)] * 3), axis=-1)
    points = grid.reshape(-1, 3) * np.array(size)
    assert _outside(points, cover) <= 1e-15
    beyond = np.maximum(np.abs(_surface(cover)) - np.array(size) / 2, 0)
    assert np.max(np.linalg.norm(beyond, axis=1)) <= cover.inflation + 1e-12
    tighter = type(cover)(cover.centers, cover.radius - 1e-9, 0.0)
    assert _outside(points, tighter) > 0.0


def test_box_keeps_within_its_budget():
    cover = cover_box((1.0, 1.0, 0.01), inflation=1e-4, most=16)
    assert len(cover.centers) <= 16
    assert cover.inflation > 1e-4
