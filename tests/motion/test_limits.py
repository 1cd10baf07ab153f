import numpy as np
import pytest

from rrnn_opt.motion import Trajectory
from rrnn_opt.motion.limits import ROOM, position_excess, slow_down


def bump(height, duration):
    """Up and back: speed 1.5 height / (T/2), acceleration 6 height / (T/2)^2."""
    t = [0.0, duration / 2, duration]
    return Trajectory.from_rows(t, [[0.0], [height], [0.0]], np.zeros((3, 1)))


def test_speed_alone_can_call_for_a_stretch(limits_of, dense):
    limits = limits_of(1, velocity=0.5, acceleration=1e3)
    raw = bump(1.0, 2.0)  # 1.5 rad/s
    slow = slow_down(raw, limits)
    assert slow.duration == pytest.approx(3 * raw.duration * (1 + ROOM))
    assert 0.999 < dense(slow, limits)[0] <= 1


def test_acceleration_alone_can_call_for_a_stretch(limits_of, dense):
    limits = limits_of(1, velocity=1e3, acceleration=1.5)
    raw = bump(1.0, 2.0)  # 6 rad/s2
    slow = slow_down(raw, limits)
    assert slow.duration == pytest.approx(2 * raw.duration * (1 + ROOM))
    assert 0.999 < dense(slow, limits)[1] <= 1


def test_what_keeps_its_limits_is_left_alone(limits_of):
    raw = bump(0.1, 2.0)
    assert slow_down(raw, limits_of(1)) is raw


def test_positions_are_judged_between_rows(limits_of):
    rows = Trajectory.from_rows([0.0, 1.0], [[0.9], [0.9]], [[1.0], [-1.0]])
    # the parabola's top is 0.25 above its rows
    assert position_excess(rows, limits_of(1, bound=1.0)) == pytest.approx(0.15)
    assert position_excess(rows, limits_of(1, bound=2.0)) == pytest.approx(-0.85)
