import numpy as np
import pytest

from rrnn_opt.report.plan.stage import Workspace, drawn, obstacles_of
from rrnn_opt.scene import Box, Capsule, Cylinder, HalfSpace, Sphere
from rrnn_opt.scene.distance import distance_function

SPACE = Workspace(np.array([-1.0, -1.0, 0.0]), np.array([1.0, 1.0, 1.5]))
TURNED = [0.0, np.sin(0.3), 0.0, np.cos(0.3)]
SHAPES = [
    Box("b", [0.4, 0.3, 0.9], [0.1, 0.2, 0.4], TURNED),
    Cylinder("c", 0.2, 0.7, [0.1, -0.4, 0.5], TURNED),
    Capsule("k", 0.15, 0.4, [-0.3, 0.2, 0.7], TURNED),
    Sphere("s", 0.25, [0.2, 0.1, 0.6]),
    HalfSpace("h", [0.0, 0.6, 0.8], 0.3),
]


@pytest.mark.parametrize("shape", SHAPES, ids=lambda s: s.kind)
def test_what_is_drawn_lies_on_the_surface(shape):
    solid = drawn(shape, SPACE, tile=0.1)
    distance = distance_function(shape.kind)(solid.vertices.T, shape.pack())[0]
    assert len(solid.quads) > 0
    on_rim = np.abs(np.array(distance)).ravel()
    ends = {"cylinder": 0.21}.get(shape.kind, 1e-9)  # its flat ends reach inside
    assert on_rim.max() < ends


def test_a_wall_is_cut_to_the_workspace_and_keeps_its_thickness():
    wall = Box("wall", [0.02, 30.0, 30.0], [0.4, 0.0, 0.0])
    points = drawn(wall, SPACE, tile=0.2).vertices
    np.testing.assert_allclose(points.min(0), [0.39, -1.0, 0.0])
    np.testing.assert_allclose(points.max(0), [0.41, 1.0, 1.5])


def test_what_is_far_away_has_no_faces():
    assert len(drawn(Box("far", [1, 1, 1], [9, 0, 0]), SPACE, tile=0.2).quads) == 0
    below = HalfSpace("floor", [0, 0, 1], -3.0)
    assert len(drawn(below, SPACE, tile=0.2).quads) == 0


def test_unknown_shapes_are_named_instead_of_drawn(every_shape):
    shapes, others = obstacles_of(every_shape)
    assert [s.kind for s in shapes] == [
        "box",
        "cylinder",
        "capsule",
        "sphere",
        "halfspace",
    ]
    assert others == ["blob (mesh)"]
