import casadi as ca
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.errors import RrnnError
from rrnn_opt.formulations.contacts import contacts_of
from rrnn_opt.formulations.signs import Band, entry_magnitudes, sign_jacobian
from tests.formulations.points import posture, sphere_jacobian, unit_normals

LAWS = settings(max_examples=60)
BAND = Band(inner=0.03, outer=0.11)


def shape(d):
    gap = ca.SX.sym("d")
    f = ca.Function("f", [gap], [BAND.share(gap), BAND.slope(gap)])
    return tuple(float(x) for x in f(d))


@LAWS
@given(st.floats(0.0, 0.2))
def test_the_share_falls_smoothly_from_one_to_zero(d):
    share, slope = shape(d)
    rise = (shape(d + 1e-6)[0] - shape(d - 1e-6)[0]) / 2e-6
    assert slope == pytest.approx(rise, abs=1e-2)
    assert 0.0 <= share <= 1.0
    assert slope >= 0.0
    if d <= BAND.inner:
        assert share == 0.0
    if d >= BAND.outer:
        assert share == 1.0


@pytest.mark.parametrize("ends", [(0.1, 0.1), (-0.1, 0.1), (0.1, np.inf), (0.2, 0.1)])
def test_a_band_has_two_ends(ends):
    with pytest.raises(RrnnError, match="inner < outer"):
        Band(*ends)


def test_sphere_jacobians_and_signs_against_finite_differences(every):
    count, rng = len(every.robot.spheres), np.random.default_rng(1)
    spheres = (count // 3, count - 1)
    found = contacts_of(every, spheres)
    outputs = [sign_jacobian(found), found.gradients]
    f = ca.Function("f", [every.q, found.normals.sx], outputs)
    q, n = posture(every, rng), unit_normals(every, rng, 2)
    signs, gradients = (np.asarray(x) for x in f(q, n))
    for i, sphere in enumerate(spheres):
        J = sphere_jacobian(every, sphere, q)
        rows = signs[3 * i : 3 * i + 3]
        np.testing.assert_allclose(rows, -np.sign(n[:, [i]]) * J, atol=1e-8)
        np.testing.assert_allclose(gradients[i], n[:, i] @ J, atol=1e-8)


def test_what_is_stored_at_entry_lets_the_motion_go_on(pa10):
    store = entry_magnitudes(pa10, (42,))
    rng = np.random.default_rng(3)
    q, qd, n = posture(pa10, rng), rng.normal(size=7), unit_normals(pa10, rng, 1)
    towards = -np.sign(n.ravel()) * (sphere_jacobian(pa10, 42, q) @ qd)
    stored = np.asarray(store(q, qd, n)).ravel()
    np.testing.assert_allclose(stored, np.maximum(towards, 0), atol=1e-8)
    assert 0 < np.count_nonzero(stored) < 3


def test_contacts_must_be_there(pa10):
    with pytest.raises(RrnnError, match="no sphere 43; pa10 has 43"):
        contacts_of(pa10, (43,))
    with pytest.raises(RrnnError, match="no sphere -1"):
        contacts_of(pa10, (-1,))
    with pytest.raises(RrnnError, match="give at least one contact"):
        sign_jacobian(contacts_of(pa10, ()))
