"""``plan``: what each case is called, and that a solved plan really is one."""

import json
import time

import numpy as np
import pytest

from rrnn_opt import check
from rrnn_opt.errors import CompilerError, ProblemError
from rrnn_opt.planning import Problem, plan, planner


@pytest.fixture
def planned(window_problem):
    return plan(Problem.from_dict(window_problem()), seed=1)


def without_times(document):
    """The document less what a clock decides."""
    if isinstance(document, dict):
        return {
            k: without_times(v) for k, v in document.items() if not k.endswith("_s")
        }
    return document


def test_solved_means_proved_from_start_to_goal(planned, window_problem):
    document = json.loads(json.dumps(planned.to_dict(), allow_nan=False))
    assert planned.status == "solved"
    assert planned.exit_code == 0
    again = check.certify_trajectory(
        document["robot"], document["problem"], document["trajectory"]
    )
    assert (again.collision_free, again.limits) == ("PROVED", "PROVED")
    trajectory = document["trajectory"]
    assert trajectory["q"][0] == window_problem()["start"]
    assert trajectory["t"][0] == 0.0
    assert set(trajectory["qd"][0]) == set(trajectory["qd"][-1]) == {0.0}
    assert document["certificate"]["goal_error"] <= 1e-3
    stats = document["stats"]
    assert stats["explorations"] == stats["random"] + stats["heuristic"]
    assert len(stats["memory_cell"]) == stats["explorations"]


def test_the_same_seed_gives_the_same_document(window_problem):
    problem = Problem.from_dict(window_problem())
    first, second = (plan(problem, seed=5).to_dict() for _ in range(2))
    assert without_times(first) == without_times(second)


def test_joint_goal_is_reached_to_the_last_bit(planned, window_problem):
    goal = planned.path[-1]
    problem = Problem.from_dict(window_problem(goal={"joints": goal.tolist()}))
    result = plan(problem)
    assert result.solved
    assert result.trajectory["q"][-1] == goal.tolist()


def test_pose_goal_among_several(window_problem):
    pose = {"position": [0.25, 0.3, 0.8], "quat_xyzw": [0.0, 1.0, 0.0, 0.0]}
    far = {"position": [3.0, 0.0, 0.0]}
    result = plan(Problem.from_dict(window_problem(goal=[far, pose])))
    assert result.solved
    assert result.certificate["goal_angle_error"] <= 1e-2


def test_start_equal_to_goal(window_problem):
    start = window_problem()["start"]
    result = plan(Problem.from_dict(window_problem(goal={"joints": start})))
    assert result.solved


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"goal": {"position": [0.0, 0.0, 3.0]}}, "goal is beyond reach"),
        ({"goal": {"position": [0.0, 0.0, 900.0]}}, "positions are metres"),
        ({"margin": 0.2}, "start is too close"),
        (
            {
                "obstacles": [
                    {
                        "name": "egg",
                        "type": "sphere",
                        "radius": 0.2,
                        "position": [0, 0, 0.4],
                    }
                ]
            },
            "start is in collision: link 'upper_arm' and 'egg' overlap",
        ),
    ],
)
def test_infeasible_only_with_a_witness(window_problem, change, words):
    result = plan(Problem.from_dict(window_problem(**change)))
    assert result.status == "infeasible"
    assert result.exit_code == 1
    assert words in result.message
    assert result.to_dict()["witness"]
    assert result.to_dict()["stats"]["explorations"] == 0


def test_goal_in_collision(planned, window_problem):
    data = window_problem(goal={"joints": planned.path[-1].tolist()})
    data["obstacles"].append(
        {"name": "pin", "type": "sphere", "radius": 0.05, "position": [0.7, 0.05, 0.45]}
    )
    result = plan(Problem.from_dict(data))
    assert (result.status, result.message[:21]) == (
        "infeasible",
        "goal is in collision:",
    )


def test_budget_and_time_limit_are_told_apart(window_problem):
    fins = [
        {
            "name": f"fin{x}",
            "type": "box",
            "position": [x, 0.0, 0.0],
            "size": [2.4, 0.02, 0.2],
        }
        for x in (-1.4, 1.4)
    ]
    up = [1.5, 0.3, 0.3]
    data = {
        "robot": "planar3",
        "start": up,
        "goal": {"joints": [-a for a in up]},
        "obstacles": fins,
    }
    problem = Problem.from_dict(data)
    assert plan(problem, max_explorations=50).status == "budget_exhausted"
    begin = time.process_time()
    late = plan(problem, time_limit=0.05, max_explorations=10**9)
    assert late.status == "time_limit"
    assert time.process_time() - begin < 2.0


def test_margin_is_kept_by_the_delivered_trajectory(window_problem):
    result = plan(Problem.from_dict(window_problem(half=0.2, margin=0.01)), seed=2)
    assert result.solved
    assert result.certificate["clearance_lower_bound"] >= 0.0


def test_interruption_keeps_what_was_found(window_problem, monkeypatch):
    def interrupted(*_args, **_kwargs):
        raise KeyboardInterrupt

    monkeypatch.setattr(planner, "deliver", interrupted)
    result = plan(Problem.from_dict(window_problem()))
    assert (result.status, result.exit_code) == ("interrupted", 130)
    assert len(result.path) >= 2


def test_unknown_planner_and_budget_are_refused(window_problem):
    problem = Problem.from_dict(window_problem())
    with pytest.raises(ProblemError, match="random-rnn"):
        plan(problem, planner="magic")
    with pytest.raises(ProblemError, match="positive"):
        plan(problem, max_explorations=0)


def test_without_a_compiler_one_sentence(window_problem, monkeypatch, tmp_path):
    from rrnn_opt.planning.search import cache

    def none(*_args, **_kwargs):
        raise CompilerError("no C compiler; install gcc")

    cache._runtime.cache_clear()
    monkeypatch.setattr("rrnn_opt.emit.build", none)
    with pytest.raises(CompilerError, match="install"):
        plan(Problem.from_dict(window_problem()))


def test_no_learning_uses_a_coin(window_problem):
    result = plan(Problem.from_dict(window_problem()), planner="no-learning")
    assert result.solved
    assert set(result.stats.memory_cell) == {0.5}


def test_stats_hold_numbers_only(planned):
    assert np.isfinite(planned.stats.time_s)
    assert planned.stats.plan_time_s < planned.stats.time_s
