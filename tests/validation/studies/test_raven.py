"""Raven II through the 4 cm opening: the scene is what it says, and is solved."""

import casadi as ca
import numpy as np
import pytest

from rrnn_opt.planning import Problem
from rrnn_opt.robot import Kinematics, Robot
from rrnn_opt.scene.library import scenario
from rrnn_opt.scene.reading import scene_from_list
from rrnn_opt.validation.studies.raven import drawn_starts, page, raven_rows

SHAFT = 0.47  # m


def test_the_shaft_always_passes_through_the_remote_centre():
    robot = Robot.builtin("raven2")
    kin = Kinematics(robot)
    pose = ca.Function("pose", [kin.q], [kin.pose("shaft_end")])
    rng = np.random.default_rng(0)
    for q in rng.uniform(robot.limits.lower, robot.limits.upper, (50, 6)):
        end = np.array(pose(q))
        # the shaft is the line through its end along z; the centre is the origin
        off = np.linalg.norm(np.cross(end[:3, 2], end[:3, 3]))
        assert off < 1e-12
        assert end[:3, 3] @ -end[:3, 2] == pytest.approx(SHAFT - q[2], abs=1e-12)


def test_the_opening_is_a_square_of_four_centimetres_and_the_box_is_closed():
    boards = {
        o.name: o for o in scene_from_list(list(scenario("raven_opening").obstacles))
    }
    axes = boards["back"].rotation
    local = {name: axes.T @ board.position for name, board in boards.items()}
    for axis, low, high in (
        (0, "front left", "front right"),
        (1, "front below", "front above"),
    ):
        least = local[low][axis] + boards[low].size[axis] / 2
        most = local[high][axis] - boards[high].size[axis] / 2
        assert most - least == pytest.approx(0.04, abs=1e-8)
    front = local["front left"][2]
    assert front == pytest.approx(0.06, abs=1e-8)
    target = axes.T @ np.array(scenario("raven_opening").target)
    assert front < target[2] < local["back"][2]
    # the straight tool would have to pass the front board beside the opening
    assert np.max(np.abs(target[:2] / target[2] * front)) > 0.02 - 0.005


def test_shipped_starts_are_the_first_of_those_drawn():
    given = scenario("raven_opening")
    assert np.array_equal(drawn_starts(50), np.array(given.starts))
    robot = Problem.from_dict(given.problem(0)).robot
    assert np.all(drawn_starts(50) >= robot.limits.lower)
    assert np.all(drawn_starts(50) <= robot.limits.upper)


def test_a_few_starts_are_solved_with_proof():
    rows = raven_rows(6)
    assert [row["start"] for row in rows] == list(range(6))
    assert [row["status"] for row in rows] == ["solved"] * 6
    assert all(row["clearance_m"] >= 0.0 for row in rows)
    assert "| solved and proved | 6 (" in page(rows, "command")
    failed = [{**rows[0], "solved": False, "status": "time_limit"}, *rows[1:]]
    assert "| other ends | 1 time_limit |" in page(failed, "command")
