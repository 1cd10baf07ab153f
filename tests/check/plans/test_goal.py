import numpy as np
import pytest

from rrnn_opt.check.plans.goal import nearest_goal
from rrnn_opt.check.plans.robot.block import read_model
from rrnn_opt.errors import DocumentError

Q = np.array([0.3, 0.4])
PLACE = np.array([np.cos(0.3) + np.cos(0.7), np.sin(0.3) + np.sin(0.7), 0.0])


def about_z(angle):
    return [0.0, 0.0, float(np.sin(angle / 2)), float(np.cos(angle / 2))]


@pytest.fixture
def model(planar):
    return read_model(planar)


def test_a_region_lies_in_the_goals_own_axes(model):
    """An edge of 4 cm along the turned x axis lets the tip be 2 cm off in y."""
    goal = {
        "position": (PLACE + np.array([0.0, 0.02, 0.0])).tolist(),
        "quat_xyzw": about_z(np.pi / 2),
        "angle_tolerance": 3.0,
        "region": {"box": [0.04, 0.0, 0.0]},
    }
    assert nearest_goal(model, goal, Q).error == pytest.approx(0.0, abs=1e-12)
    goal["quat_xyzw"] = about_z(0.0)
    assert nearest_goal(model, goal, Q).error == pytest.approx(0.02)


def test_a_free_axis_does_not_count(model):
    goal = {"position": PLACE.tolist(), "quat_xyzw": about_z(2.0), "free_axis": "z"}
    assert nearest_goal(model, goal, Q).reached
    found = nearest_goal(model, {**goal, "free_axis": "x"}, Q)
    assert found.angle == pytest.approx(2.0 - 0.7)
    assert not found.reached


@pytest.mark.parametrize("angle", [0.0, 1e-9, 1e-4, 1.0, np.pi - 1e-6, np.pi])
def test_angles_are_exact_from_zero_to_half_a_turn(model, angle):
    goal = {"position": PLACE.tolist(), "quat_xyzw": about_z(0.7 + angle)}
    assert nearest_goal(model, goal, Q).angle == pytest.approx(angle, abs=1e-12)


def test_a_reached_goal_is_preferred_to_a_nearer_one(model):
    off = (PLACE + np.array([2e-3, 0, 0])).tolist()
    far = (PLACE + np.array([5e-3, 0, 0])).tolist()
    goals = [{"position": off}, {"position": far, "tolerance": 0.01}]
    found = nearest_goal(model, goals, Q)
    assert found.reached
    assert found.error == pytest.approx(5e-3)


@pytest.mark.parametrize(
    "goal",
    [
        [],
        3,
        {},
        {"position": [0, 0]},
        {"joints": [1.0]},
        {"position": [0, 0, 0], "tolerance": 0},
        {"position": [0, 0, 0], "region": {}},
        {"position": [0, 0, 0], "region": {"box": [0.1, -0.1, 0.1]}},
        {"position": [0, 0, 0], "quat_xyzw": [0, 0, 0, 1], "free_axis": "w"},
    ],
)
def test_malformed_goals_are_refused(model, goal):
    with pytest.raises(DocumentError, match="goal"):
        nearest_goal(model, goal, Q)
