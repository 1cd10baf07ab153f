"""Parts of surfaces: nothing is lost when they are cut, and nothing multiplies."""

from __future__ import annotations

import numpy as np
from hypothesis import Phase, example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from rrnn_opt.robot.fitting.solid_cover import Part, Surface, halves, solid_parts

Array = NDArray[np.float64]


def hull(seed: int) -> Surface:
    """Hull of a few random points, its triangles outwards."""
    points = np.random.default_rng(seed).normal(size=(8, 3)) * (0.3, 0.1, 0.02)
    return Surface(points, ConvexHull(points).simplices.astype(np.int64))


def area(polygons: Array) -> float:
    """Of planar polygons (t, k, 3), by fans about their means, m^2."""
    middle = polygons.mean(axis=1, keepdims=True)
    rays, after = polygons - middle, np.roll(polygons, -1, axis=1) - middle
    return 0.5 * float(np.linalg.norm(np.cross(rays, after), axis=2).sum())


@settings(max_examples=6, phases=[Phase.explicit, Phase.generate])
@example(600, [False, True] * 7)
@given(st.integers(0, 10_000), st.lists(st.booleans(), max_size=14))
def test_cut_again_and_again(seed: int, sides: list[bool]) -> None:
    surface = hull(seed)
    (part,) = solid_parts(surface, np.inf, 1)
    for side in sides:
        both = halves(part, surface)
        whole = sum(area(each.corners) for each in both)
        assert np.isclose(whole, area(part.corners), rtol=1e-9)
        part = both[min(int(side), len(both) - 1)]
        assert len(part.corners) <= len(surface.corners)
        assert held(part)


def held(part: Part) -> bool:
    """All corners lie in the ball of the part."""
    away = np.linalg.norm(part.corners - part.center, axis=2)
    return bool(np.all(away <= part.radius))
