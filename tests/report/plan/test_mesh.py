import numpy as np
import pytest

from rrnn_opt.report.plan import mesh


def volume(solid: mesh.Mesh) -> float:
    """Enclosed volume by the divergence theorem; negative when inside out."""
    a, b, c = (solid.vertices[solid.triangles[:, k]] for k in range(3))
    return float(np.sum(np.einsum("ij,ij->i", a, np.cross(b, c)))) / 6.0


def test_a_box_is_closed_and_faces_outwards():
    low, high = np.array([-1.0, 0.0, 2.0]), np.array([1.0, 0.5, 5.0])
    for tile in (0.2, np.inf):
        assert volume(mesh.box(low, high, tile=tile)) == pytest.approx(3.0)


@pytest.mark.parametrize(
    ("solid", "wanted"),
    [
        (mesh.sphere([1, 2, 3], 0.5, sides=80), 4 / 3 * np.pi * 0.5**3),
        (mesh.cylinder_z(0.3, -1.0, 2.0, sides=200), np.pi * 0.3**2 * 3),
        (
            mesh.capsule(np.zeros(3), np.array([0.6, 0.0, 0.8]), 0.2, sides=120),
            np.pi * 0.2**2 + 4 / 3 * np.pi * 0.2**3,
        ),
    ],
)
def test_round_solids_have_their_volume(solid, wanted):
    assert volume(solid) == pytest.approx(wanted, rel=5e-3)


def test_a_capsule_lies_within_its_radius_of_its_segment():
    a, b = np.array([0.1, -0.2, 0.3]), np.array([0.1, 0.7, 0.3])
    points = mesh.capsule(a, b, 0.1).vertices
    share = np.clip((points - a) @ (b - a) / np.dot(b - a, b - a), 0, 1)
    distance = np.linalg.norm(points - (a + share[:, None] * (b - a)), axis=1)
    np.testing.assert_allclose(distance, 0.1, atol=1e-12)


def test_nothing_merged_is_an_empty_mesh():
    empty = mesh.merged([])
    assert empty.corners.shape == (0, 4, 3)
    assert len(empty.triangles) == 0
