import numpy as np

from rrnn_opt.report.plan import mesh
from rrnn_opt.report.plan.camera import View, best_view, unhidden


def test_axes_are_a_right_handed_frame():
    axes = View(30.0, 110.0).axes
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
    np.testing.assert_allclose(np.cross(axes[0], axes[1]), axes[2], atol=1e-12)
    assert axes[1, 2] > 0  # up is up


def test_a_view_from_behind_a_wall_is_not_taken():
    low, high = np.array([0.4, -1.0, 0.0]), np.array([0.42, 1.0, 2.0])
    wall = mesh.box(low, high, tile=0.1).corners
    line = np.linspace(-0.6, 0.6, 20)
    points = np.column_stack([np.full(20, -0.2), line, np.full(20, 0.8)])
    assert best_view(points, wall, cell=0.1).towards_viewer[0] < 0.1
    mirrored = best_view(points * [-1, 1, 1], wall * [-1, 1, 1], cell=0.1)
    assert mirrored.towards_viewer[0] > -0.1


def test_a_flat_motion_is_seen_from_above():
    angle = np.linspace(0, 3, 30)
    arc = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(30)])
    nothing = np.zeros((0, 4, 3))
    assert best_view(arc, nothing, cell=0.1).elevation >= 50.0


def test_only_what_stands_in_front_hides():
    low, high = np.array([0.4, -1.0, -1.0]), np.array([0.42, 1.0, 1.0])
    wall = mesh.box(low, high, tile=0.1).corners.mean(axis=1)
    points = np.array([[0.0, 0.0, 0.0], [0.0, 0.3, -0.2]])
    assert unhidden(View(0.0, 0.0), points, wall, 0.1) == 0.0
    assert unhidden(View(0.0, 180.0), points, wall, 0.1) == 1.0
    aside = np.array([[0.0, 0.0, 0.0], [0.0, 5.0, 0.0]])
    assert unhidden(View(0.0, 0.0), aside, wall, 0.1) == 0.5
