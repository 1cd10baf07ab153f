"""The rolled-out schemes against the declared ones, and what plans of them are."""

import dataclasses
import itertools

import numpy as np
import pytest

from rrnn_opt import check
from rrnn_opt.errors import ProblemError
from rrnn_opt.planning import PaperRnn, Problem, RandomRnn, plan
from rrnn_opt.planning.rollout.library import (
    thinned,
)
from rrnn_opt.robot.reach import reach_ball
from tests.planning.rollout.planar import document, opened, tip, walled


def test_contact_only_never_wakes_the_cell_when_sets_stop_the_arm():
    """With (12) kept exactly no step collides, so I = 0 and x = 0 for ever."""
    problem = Problem.from_dict(walled())
    first = PaperRnn(order="first", safe=0.05)
    result = plan(problem, settings=first, planner="paper", max_explorations=40)
    assert result.status == "budget_exhausted"
    assert set(result.stats.memory_cell) == {0.0}
    assert result.stats.random == 0
    fed = dataclasses.replace(first, feed="failure")
    result = plan(problem, settings=fed, planner="paper", max_explorations=40)
    assert result.stats.random > 5
    assert max(result.stats.memory_cell) == pytest.approx(0.6413, abs=1e-3)


def test_paper_solves_what_needs_no_luck_and_its_path_is_proved():
    problem = Problem.from_dict(document(obstacles=[]))
    result = plan(problem, planner="paper", seed=2)
    assert (result.status, result.stats.heuristic) == ("solved", 1)
    again = check.certify_trajectory(result.robot, result.problem, result.trajectory)
    assert (again.collision_free, again.limits) == ("PROVED", "PROVED")


@pytest.mark.parametrize("planner", ["method1", "method2"])
def test_single_rollouts_say_that_they_are_single(planner):
    """Around the ball and in front of it; z is no task of a planar arm."""
    solved = plan(Problem.from_dict(document(obstacles=[])), planner=planner)
    assert solved.status == "solved"
    result = plan(Problem.from_dict(walled()), planner=planner, max_explorations=50)
    assert result.status == "budget_exhausted"
    assert "single rollout" in result.message
    assert result.stats.heuristic == 1


def test_only_positions_are_goals_of_the_printed_schemes():
    problem = Problem.from_dict(document(goal={"joints": [0.5] * 3}, obstacles=[]))
    with pytest.raises(ProblemError, match="'paper' goes to positions"):
        plan(problem, planner="paper")


def test_the_same_seed_rolls_the_same_tree():
    problem = Problem.from_dict(document())
    settings = PaperRnn(coin=0.5)
    trees = []
    for seed in (5, 5, 6):
        with opened(problem, settings, seed) as search:
            status = "paused"
            while status == "paused":
                status = search.run(12, 1e-9 if len(trees) == 1 else 10.0)
            trees.append(search.nodes()[0])
    np.testing.assert_array_equal(trees[0], trees[1])
    assert trees[0].shape != trees[2].shape or np.any(trees[0] != trees[2])


def test_the_way_to_a_node_is_rolled_again_to_the_last_bit():
    problem = Problem.from_dict(document())
    with opened(problem, PaperRnn(coin=0.5), 3) as search:
        search.run(10, 10.0)
        postures, parents = search.nodes()
        assert len(postures) > 3
        for node in range(len(postures)):
            way = search.way(node)
            np.testing.assert_array_equal(way[0], problem.start)
            np.testing.assert_array_equal(way[-1], postures[node])
            assert parents[node] < node
            short = thinned(search, way)
            pairs = itertools.pairwise(short)
            assert all(search.segment_free(a, b) for a, b in pairs)
        with pytest.raises(IndexError, match="T_s has nodes"):
            search.way(len(postures))


def test_random_points_lie_in_the_ball_of_reach(planar):
    """Every tip that a rollout reached is within reach; so are its targets."""
    centre, radius = reach_ball(planar)
    problem = Problem.from_dict(document(obstacles=[]))
    with opened(problem, PaperRnn(coin=1.0), 1) as search:
        search.run(30, 10.0)
        postures, _ = search.nodes()
        tips = np.array([tip(planar, q) for q in postures])
    assert np.all(np.linalg.norm(tips - centre, axis=1) <= radius + 1e-9)
    assert len(np.unique(tips[:, 0].round(6))) > 10


def test_a_search_without_switches_differs_from_one_with(planar_runtime, open_search):
    """The switches reach the runtime: each changes what the search does."""
    problem = Problem.from_dict(document(goal={"joints": [1.9, 0.4, 0.5]}))
    base = RandomRnn(coin=1.0)
    counts = []
    for change in ({}, {"project": False}, {"connect": False}):
        settings = dataclasses.replace(base, **change)
        with open_search(planar_runtime, problem, 4, settings) as search:
            search.run(60, 10.0)
            counts.append(search.counts())
    assert counts[0].rollout_steps != counts[1].rollout_steps
    assert counts[0].heuristic > 0
    assert counts[2].heuristic == 0
