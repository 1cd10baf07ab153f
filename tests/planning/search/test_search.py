"""The search: what it finds, what it must not find, and that seeds decide."""

import dataclasses
import itertools

import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.planning import Problem, RandomRnn
from rrnn_opt.planning.problem.goals import goals_from_data
from rrnn_opt.scene.reading import scene_from_list


def run(search, budget=3000):
    status = "paused"
    while status == "paused":
        status = search.run(budget, 10.0)
    return status


def test_the_path_joins_start_and_goal_and_every_piece_is_proved(
    pa10, pa10_runtime, window_problem, open_search
):
    problem = Problem.from_dict(window_problem())
    position = rr.Kinematics(pa10).functions()["position"]
    with open_search(pa10_runtime, problem) as search:
        assert run(search) == "solved"
        path = search.path()
        np.testing.assert_array_equal(path[0], problem.start)
        tip = np.array(position(path[-1])).ravel()
        assert np.linalg.norm(tip - [0.7, 0.05, 0.45]) <= 1e-3
        assert np.all(path >= pa10.limits.lower)
        assert np.all(path <= pa10.limits.upper)
        pieces = itertools.pairwise(path)
        assert all(search.segment_free(a, b) for a, b in pieces)


@pytest.mark.parametrize("offset", [(0.05, 0.0), (-0.05, 0.0), (0.0, 0.05)])
def test_a_moved_window_is_still_found(
    pa10_runtime, window_problem, open_search, offset
):
    problem = Problem.from_dict(window_problem(offset))
    with open_search(pa10_runtime, problem) as search:
        assert run(search) == "solved"


def test_a_wall_without_a_window_is_not_passed(
    pa10_runtime, window_problem, open_search
):
    data = window_problem()
    wall = {"name": "wall", "type": "box", "position": [0.42, 0, 0.5]}
    data["obstacles"] = [{**wall, "size": [0.02, 3.0, 3.0]}]
    problem = Problem.from_dict(data)
    with open_search(pa10_runtime, problem) as search:
        assert run(search, 200) == "no_goal_posture"
        assert len(search.path()) == 0


def test_separated_halves_exhaust_the_budget(planar_runtime, open_search):
    """Two fins along x cut the arm's plane: up and down are not connected."""
    fins = [
        {"type": "box", "position": [x, 0.0, 0.0], "size": [2.4, 0.02, 0.2]}
        for x in (-1.4, 1.4)
    ]
    up = [np.pi / 2, 0.3, 0.3]
    problem = Problem.from_dict(
        {
            "robot": "planar3",
            "start": up,
            "goal": {"joints": [-a for a in up]},
            "obstacles": [{"name": f"fin{i}", **f} for i, f in enumerate(fins)],
        }
    )
    with open_search(planar_runtime, problem) as search:
        assert run(search, 200) == "budget_exhausted"
        counts = search.counts()
        assert counts.random + counts.heuristic == 200
        assert counts.random > 5
        assert len(search.path()) == 0


def test_no_free_goal_posture_is_said(pa10_runtime, window_problem, open_search):
    data = window_problem()
    cage = {"name": "cage", "type": "sphere", "position": [0.7, 0.05, 0.45]}
    data["obstacles"] = [{**cage, "radius": 0.1}]
    problem = Problem.from_dict(data)
    with open_search(pa10_runtime, problem) as search:
        assert run(search) == "no_goal_posture"


def test_the_seed_decides_the_path(pa10_runtime, window_problem, open_search):
    problem = Problem.from_dict(window_problem())
    paths = []
    for seed in (3, 3, 4):
        with open_search(pa10_runtime, problem, seed=seed) as search:
            status = "paused"
            while status == "paused":  # pausing early must not matter
                status = search.run(3000, 1e-6 if len(paths) == 1 else 10.0)
            paths.append(search.path())
    np.testing.assert_array_equal(paths[0], paths[1])
    assert paths[0].shape != paths[2].shape or np.any(paths[0] != paths[2])


def test_activity_is_recorded_before_each_exploration(
    pa10_runtime, window_problem, open_search
):
    problem = Problem.from_dict(window_problem())
    for seed in range(20):
        with open_search(pa10_runtime, problem, seed=seed) as search:
            run(search)
            counts, activity = search.counts(), search.activity()
            assert len(activity) == counts.random + counts.heuristic
            assert activity[0] == 0.0
            assert np.all((activity >= 0.0) & (activity <= 0.6414))
    coin = dataclasses.replace(RandomRnn(), coin=0.5)
    with open_search(pa10_runtime, problem, settings=coin) as search:
        run(search)
        assert set(search.activity()) == {0.5}


def test_planar_arm(planar_runtime, open_search):
    problem = Problem.from_dict(
        {
            "robot": "planar3",
            "start": [0.9, 0.3, 0.2],
            "goal": {"joints": [-0.9, -0.3, -0.2]},
            "obstacles": [
                {
                    "name": "ball",
                    "type": "sphere",
                    "radius": 0.2,
                    "position": [1.9, 0, 0],
                }
            ],
        }
    )
    with open_search(planar_runtime, problem) as search:
        assert run(search) == "solved"
        np.testing.assert_array_equal(search.path()[-1], [-0.9, -0.3, -0.2])


TURNTABLE = """<robot name="turntable"><link name="base"/><link name="arm">
<collision><origin xyz="0.5 0 0"/><geometry><sphere radius="0.05"/></geometry>
</collision></link><joint name="turn" type="revolute"><parent link="base"/>
<child link="arm"/><axis xyz="0 0 1"/>
<limit lower="-2" upper="2" velocity="1" effort="1"/></joint></robot>"""


def test_a_passage_narrower_than_the_steering_margin_is_entered(tmp_path):
    """A ball that can only go round passes a beam 0.8 mm above it."""
    file = tmp_path / "turntable.urdf"
    file.write_text(TURNTABLE)
    beam = {"name": "beam", "type": "box", "size": [0.4, 0.04, 0.1]}
    problem = Problem(
        rr.Robot.from_urdf(file),
        np.array([-1.0]),
        goals=goals_from_data({"joints": [1.0]}),
        scene=scene_from_list([{**beam, "position": [0.5, 0.0, 0.1008]}]),
    )
    for close_after, status in ((10**9, "budget_exhausted"), (0, "solved")):
        settings = dataclasses.replace(RandomRnn(), close_after=close_after)
        found = rr.plan(problem, settings=settings, max_explorations=300)
        assert found.status == status
