"""Odd but valid or invalid problems: each has a status that says what is wrong."""

import numpy as np
import pytest

from rrnn_opt.errors import ProblemError
from rrnn_opt.planning import Problem, plan


@pytest.mark.parametrize("size", [[0.1, 0.0, 0.1], [0.0, 0.0, 0.0], [0.1, -0.1, 0.1]])
def test_a_box_without_volume_is_refused_by_name(
    window_problem, size, tmp_path, capsys
):
    data = window_problem()
    flat = {"name": "flat", "type": "box", "size": size, "position": [1.0, 0.0, 0.0]}
    data["obstacles"].append(flat)
    with pytest.raises(ProblemError, match="greater than zero"):
        Problem.from_dict(data)


def test_duplicate_obstacles_change_nothing_but_their_number(window_problem):
    data = window_problem(half=0.2)
    twice = [{**o, "name": f"{o['name']} again"} for o in data["obstacles"]]
    once = plan(Problem.from_dict(data), seed=1)
    both = plan(
        Problem.from_dict({**data, "obstacles": data["obstacles"] + twice}), seed=1
    )
    assert once.solved
    assert both.solved
    assert both.certificate["clearance_lower_bound"] >= 0.0


def test_a_start_that_is_the_goal_is_solved_at_once(window_problem):
    start = window_problem()["start"]
    result = plan(Problem.from_dict(window_problem(goal={"joints": start})))
    assert result.solved
    assert np.allclose(result.path, start, atol=1e-9)
    assert result.stats.random == 0


def test_a_margin_larger_than_the_gap_around_the_start_is_infeasible(window_problem):
    result = plan(Problem.from_dict(window_problem(margin=0.2)))
    assert result.status == "infeasible"
    assert "start is too close" in result.message


def test_a_margin_larger_than_the_window_proves_nothing(window_problem):
    """The way is shut by the margin; a spent budget does not say so."""
    problem = Problem.from_dict(window_problem(margin=0.04))
    result = plan(problem, seed=1, max_explorations=40)
    assert result.status in ("budget_exhausted", "no_goal_posture", "infeasible")
    assert result.exit_code == 1
    if result.status != "infeasible":
        assert "no proof" in result.message or "proves nothing" in result.message


@pytest.mark.slow
def test_twenty_thousand_obstacles(window_problem):
    """Behind the base, where this motion does not go: it stays proved."""
    places = np.random.default_rng(0).uniform(
        [-3.0, -2.0, -1.0], [-1.4, 2.0, 2.0], (20_000, 3)
    )
    eggs = [
        {"name": f"egg{i}", "type": "sphere", "radius": 0.02, "position": p.tolist()}
        for i, p in enumerate(places)
    ]
    data = window_problem(half=0.2)
    result = plan(
        Problem.from_dict({**data, "obstacles": data["obstacles"] + eggs}), seed=1
    )
    assert result.status == "solved", result.message
