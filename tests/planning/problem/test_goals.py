"""Regions and free axes: the drive's errors are the checker's, and plans reach them."""

from functools import cache

import casadi as ca
import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.check.plans.goal import nearest_goal
from rrnn_opt.check.plans.robot.block import read_model
from rrnn_opt.planning import Problem
from rrnn_opt.planning.kernel.drives import drive_functions
from rrnn_opt.planning.problem.goals import TipGoal, goals_from_data
from rrnn_opt.planning.search.request import tip_target

PLACE = [0.45, 0.1, 0.6]
TURNED = [0.5, -0.5, 0.5, 0.5]


@cache
def functions(robot):
    """(kinematics at q, the emitted drives) of a robot."""
    kin = rr.Kinematics(robot)
    pose = kin.pose()
    parts = [kin.axes(), kin.origins(), pose[:3, 3], pose]
    return ca.Function("at", [kin.q], parts), drive_functions(robot)


def drive_errors(robot, goal, q, length=0.1):
    """(way, chord) of the emitted drive at q, and its attraction w."""
    at, drives = functions(robot)
    axes, origins, tip, frame = (np.array(x) for x in at(q))
    target = tip_target(goal)
    wanted = np.reshape(target.rotation, (3, 3), order="F")
    named = {
        "axes": axes,
        "origins": origins,
        "tip_position": tip,
        "tip_rotation": frame[:3, :3],
        "position": np.array(target.position),
        "rotation": wanted,
        "half": np.array(target.half),
        "free": np.array(target.free),
        "length": length,
    }
    drive = drives[2 if target.has_rotation else 1]
    out = drive(**{name: named[name] for name in drive.name_in()})
    return np.array(out["error"]).ravel(), np.array(out["w"]).ravel()


@pytest.mark.parametrize("region", [None, [0.2, 0.0, 0.5]])
@pytest.mark.parametrize(
    ("quat", "free"), [(None, None), *((TURNED, axis) for axis in (None, *"xyz"))]
)
def test_the_drive_measures_what_the_checker_measures(pa10, rng, region, quat, free):
    goal = TipGoal(PLACE, quat, region=region, free_axis=free)
    model = read_model(pa10.to_dict())
    for _ in range(20):
        q = rng.uniform(-2.0, 2.0, pa10.nv)
        (way, chord), _ = drive_errors(pa10, goal, q)
        found = nearest_goal(model, goal.to_dict(), q)
        assert way == pytest.approx(found.error, abs=1e-12)
        if quat is not None:
            assert chord == pytest.approx(2 * np.sin(found.angle / 2), abs=1e-12)


def test_nothing_draws_about_a_free_axis(pa10, rng):
    """Turning the goal about its free axis changes no attraction."""
    q = rng.uniform(-1.0, 1.0, pa10.nv)
    half = np.sin(0.4), np.cos(0.4)
    x, y, z, w = TURNED
    # quaternion product TURNED * turn about z by 0.8 rad
    s, c = half
    turned = [x * c + y * s, y * c - x * s, z * c + w * s, w * c - z * s]
    plain = drive_errors(pa10, TipGoal(PLACE, TURNED, free_axis="z"), q)
    other = drive_errors(pa10, TipGoal(PLACE, turned, free_axis="z"), q)
    np.testing.assert_allclose(plain[1], other[1], atol=1e-12)
    held = drive_errors(pa10, TipGoal(PLACE, turned), q)
    assert np.abs(held[1] - plain[1]).max() > 1e-3


def test_the_document_of_a_goal_is_read_back():
    data = {
        "position": PLACE,
        "quat_xyzw": TURNED,
        "region": {"box": [0.1, 0.0, 0.2]},
        "free_axis": "y",
    }
    (goal,) = goals_from_data(data)
    assert goals_from_data(goal.to_dict())[0].to_dict() == goal.to_dict()
    assert goal.distance([0.45, 0.1, 0.6]) == 0.0


GOALS = {
    "region": {"position": [0.7, 0.05, 0.45], "region": {"box": [0.2, 0.4, 0.2]}},
    "free axis": {
        "position": [0.6, 0.05, 0.5],
        "quat_xyzw": [0.0, 0.7071067811865476, 0.0, 0.7071067811865476],
        "free_axis": "z",
    },
    "several": [
        {"position": [0.7, 9.0, 0.45]},
        {"position": [0.7, 0.05, 0.45], "tolerance": 2e-3},
    ],
}


@pytest.mark.parametrize("name", GOALS)
def test_plans_reach_them(window_problem, name):
    problem = Problem.from_dict(window_problem(goal=GOALS[name]))
    result = rr.plan(problem, seed=1)
    assert result.status == "solved", result.message


def test_goal_postures_lie_all_over_a_region(planar_runtime, open_search):
    """Two fins keep the arm above the x axis, so postures pile up below it."""
    half, middle = np.array([0.5, 0.3, 0.0]), np.array([0.0, -1.2, 0.0])
    fin = {"type": "box", "size": [2.4, 0.02, 0.2]}
    data = {
        "robot": "planar3",
        "start": [np.pi / 2, 0.3, 0.3],
        "goal": {
            "position": middle.tolist(),
            "region": {"box": (2 * half).tolist()},
        },
        "obstacles": [{**fin, "position": [x, 0.0, 0.0]} for x in (-1.4, 1.4)],
    }
    problem = Problem.from_dict(data)
    position = rr.Kinematics(problem.robot).functions()["position"]
    with open_search(planar_runtime, problem) as search:
        while search.run(60, 1.0) == "paused":
            pass
        nodes, parents = search.trees()[1]
    away = np.abs([np.array(position(q)).ravel() - middle for q in nodes[parents < 0]])
    assert len(away) >= 6
    assert np.all(away <= half + 1e-3)
    assert np.sum(np.all(away[:, :2] < half[:2] - 0.01, axis=1)) >= 4


@pytest.mark.parametrize("inside", [True, False])
def test_reach_is_judged_by_the_nearest_point_of_a_region(window_problem, inside):
    edge = 4.4 if inside else 3.0
    goal = {"position": [3.0, 0.05, 0.45], "region": {"box": [edge, 0.1, 0.1]}}
    result = rr.plan(Problem.from_dict(window_problem(goal=goal)))
    assert (result.status == "infeasible") is not inside
