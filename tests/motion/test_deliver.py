from typing import NamedTuple

import numpy as np
import pytest

from rrnn_opt.check import certify_trajectory
from rrnn_opt.errors import NotFiniteError
from rrnn_opt.motion import deliver, stop_and_go
from rrnn_opt.robot import Robot


class Verdict(NamedTuple):
    collision_free: str = "PROVED"
    limits: str = "PROVED"


CORNER = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])


def near_the_corner(allowed):
    """A certifier that wants the corner met within a distance."""

    def certify(trajectory):
        q, _, _ = trajectory.at(np.linspace(0, trajectory.duration, 3001))
        away = np.linalg.norm(q - CORNER[1], axis=1).min()
        return Verdict("PROVED" if away <= allowed else "REFUTED")

    return certify


def test_the_first_proof_is_delivered(limits_of):
    done = deliver(CORNER, limits_of(2), near_the_corner(1.0))
    assert [a.kind for a in done.attempts] == ["spline"]
    assert done.attempts[0].spacing == 0.1
    assert done.attempts[0].proved


def test_the_spacing_is_halved_until_it_is_proved(limits_of):
    done = deliver(CORNER, limits_of(2), near_the_corner(0.01))
    tried = [a.spacing for a in done.attempts]
    assert len(tried) > 1
    assert tried == sorted(tried, reverse=True)
    assert [a.proved for a in done.attempts] == [False] * (len(tried) - 1) + [True]
    assert done.certificate.collision_free == "PROVED"
    assert done.trajectory.duration == done.attempts[-1].duration


def test_the_polyline_itself_is_the_last_resort(limits_of):
    done = deliver(CORNER, limits_of(2), near_the_corner(0.0), spacings=(0.1, 0.05))
    assert [a.kind for a in done.attempts] == ["spline", "spline", "stop_and_go"]
    assert done.certificate.collision_free == "PROVED"


def test_without_a_proof_the_last_verdict_is_returned(limits_of):
    done = deliver(CORNER, limits_of(2), lambda _: Verdict("UNKNOWN"))
    assert done.certificate.collision_free == "UNKNOWN"
    assert not any(a.proved for a in done.attempts)
    assert done.attempts[-1].kind == "stop_and_go"


def test_a_failed_retiming_is_recorded_not_raised(limits_of):
    outside = [[0.0, 0.0], [4.0, 0.0]]
    done = deliver(outside, limits_of(2), lambda _: Verdict(limits="REFUTED"))
    assert "position limits" in done.attempts[0].reason
    assert done.attempts[0].duration is None
    assert done.certificate.limits == "REFUTED"


def test_malformed_waypoints_are_raised(limits_of):
    with pytest.raises(NotFiniteError):
        deliver([[0.0, 0.0], [np.nan, 0.0]], limits_of(2), lambda _: Verdict())


def test_with_the_real_checker_past_a_ball():
    """Straight lines pass the ball by 0.2 mm; the coarse spline cuts into it."""
    arm = Robot.builtin("planar3")
    robot = {**arm.to_dict(), "self_pairs": []}
    ball = {"type": "sphere", "radius": 0.1588, "position": [1.56, -1.66, 0.0]}
    points = [[-0.94, -1.09, -0.04], [-0.18, -1.23, 0.63], [-0.73, 1.22, 1.33]]
    problem = {"obstacles": [ball], "start": points[0], "goal": {"joints": points[-1]}}

    def certify(trajectory):
        return certify_trajectory(robot, problem, trajectory.to_dict())

    done = deliver(points, arm.limits, certify)
    assert [a.collision_free for a in done.attempts] == ["REFUTED", "PROVED"]
    assert done.certificate.proved
    assert 0 < done.certificate.clearance_lower_bound <= 2e-4
    assert certify(stop_and_go(points, arm.limits)).proved
