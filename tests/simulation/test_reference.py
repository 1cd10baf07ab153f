import numpy as np
import pytest

from rrnn_opt.simulation import Curve
from rrnn_opt.simulation.reference import reference

TIP = np.array([0.7, -0.1, 0.6])
CENTRE = np.array([0.5, 0.0, 0.4])
SIDE = np.array([0.0, 0.2, 0.0])
OFFSET = np.array([0.1, -0.2, 0.3])
CURVES = [
    Curve("circle", 4.0, 4.0, radius=0.2),
    Curve("circle", 4.0, 4.0, radius=0.2, plane="zx", centre=CENTRE),
    Curve("circle", 4.0, 4.0, radius=0.2, profile="uniform"),
    Curve("figure8", 4.0, 4.0, radius=0.2, plane="xy"),
    Curve("figure8", 4.0, 4.0, radius=0.2, centre=CENTRE, profile="uniform"),
    Curve("line", 4.0, 4.0, offset=OFFSET),
    Curve("line", 4.0, 4.0, position=CENTRE, profile="uniform"),
    Curve("point", 4.0, 4.0, offset=OFFSET),
]


@pytest.mark.parametrize("curve", CURVES, ids=lambda c: f"{c.kind}-{c.profile}")
def test_velocity_and_acceleration_are_the_derivatives(curve):
    t, h = np.linspace(0.1, 7.9, 60), 1e-6
    after, before = reference(curve, TIP, t + h), reference(curve, TIP, t - h)
    _, velocity, acceleration = reference(curve, TIP, t)
    slope, bend = ((after[k] - before[k]) / (2 * h) for k in (0, 1))
    np.testing.assert_allclose(slope, velocity, atol=1e-8)
    np.testing.assert_allclose(bend, acceleration, atol=1e-8)


@pytest.mark.parametrize("curve", CURVES, ids=lambda c: f"{c.kind}-{c.profile}")
def test_a_curve_through_the_start_starts_there(curve):
    if curve.centre is not None or curve.kind == "point":
        return
    np.testing.assert_allclose(reference(curve, TIP, np.zeros(1))[0][0], TIP)


def test_the_smooth_profile_rests_at_both_ends_and_runs_back():
    curve = CURVES[0]
    rd, rd_dot, _ = reference(curve, TIP, np.array([0.0, 4.0, 8.0, 1.0, 7.0]))
    np.testing.assert_allclose(rd_dot[:3], 0.0, atol=1e-15)
    np.testing.assert_allclose(rd[:3], np.tile(TIP, (3, 1)), atol=1e-15)
    np.testing.assert_allclose(rd[3], rd[4])
    np.testing.assert_allclose(rd_dot[3], -rd_dot[4])


def test_a_circle_is_round_and_in_its_plane():
    t = np.linspace(0.0, 4.0, 50)
    rd = reference(CURVES[0], TIP, t)[0]
    np.testing.assert_allclose(rd[:, 0], TIP[0])
    away = np.linalg.norm(rd - (TIP + SIDE), axis=1)
    np.testing.assert_allclose(away, 0.2)
    rd = reference(CURVES[1], TIP, t)[0]
    np.testing.assert_allclose(rd[:, 1], CENTRE[1])
    np.testing.assert_allclose(np.linalg.norm(rd - CENTRE, axis=1), 0.2)


def test_a_figure8_crosses_itself_at_its_centre():
    quarter = np.array([0.0, 0.5, 1.0, 0.25]) * 4.0
    rd = reference(CURVES[4], TIP, quarter)[0]
    np.testing.assert_allclose(rd[:3], np.tile(CENTRE, (3, 1)), atol=1e-15)
    np.testing.assert_allclose(rd[3], CENTRE + SIDE, atol=1e-15)


def test_a_line_ends_where_it_should_and_a_point_stays():
    end = reference(CURVES[5], TIP, np.array([2.0, 4.0]))[0]
    np.testing.assert_allclose(end, [TIP + OFFSET / 2, TIP + OFFSET])
    end = reference(CURVES[6], TIP, np.array([4.0]))[0][0]
    np.testing.assert_allclose(end, CENTRE, atol=1e-15)
    rd, rd_dot, _ = reference(CURVES[7], TIP, np.array([0.0, 3.0]))
    np.testing.assert_allclose(rd, np.tile(TIP + OFFSET, (2, 1)))
    assert not rd_dot.any()
