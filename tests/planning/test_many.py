"""Many plans: order, seeds and results do not depend on the workers."""

import multiprocessing
import sys
import threading
from dataclasses import replace

import numpy as np
import pytest

from rrnn_opt.errors import ProblemError
from rrnn_opt.planning import Problem, plan, plan_many


def test_processes_are_copies_only_of_one_without_threads():
    many = sys.modules["rrnn_opt.planning.many"]
    rest, done = threading.active_count() - 1, threading.Event()
    alone = sys.platform == "linux" and rest == 0
    assert many._start_method() == ("fork" if alone else "spawn")
    other = threading.Thread(target=done.wait)
    other.start()
    try:
        assert many._start_method() == "spawn"
    finally:
        done.set()
        other.join()


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_workers_change_nothing(window_problem, monkeypatch, method):
    if method not in multiprocessing.get_all_start_methods():
        pytest.skip(f"this system cannot {method}")
    if method == "fork" and threading.active_count() > 1:
        pytest.skip("a process with threads must not be copied")
    many = sys.modules["rrnn_opt.planning.many"]
    monkeypatch.setattr(many, "_start_method", lambda: method)
    problems = [Problem.from_dict(window_problem())] * 2
    alone = list(plan_many(problems, seeds=[5, 6], jobs=1))
    together = list(plan_many(problems, seeds=[5, 6], jobs=2))
    for a, b, seed in zip(alone, together, (5, 6), strict=True):
        assert a.seed == b.seed == seed
        assert a.status == b.status == "solved"
        np.testing.assert_array_equal(a.path, b.path)
        assert a.trajectory == b.trajectory
    single = plan(problems[0], seed=6)
    np.testing.assert_array_equal(single.path, alone[1].path)


def test_seeds_and_jobs_must_fit(window_problem):
    problems = [Problem.from_dict(window_problem())]
    with pytest.raises(ProblemError, match="2 seeds for 1 problems"):
        plan_many(problems, seeds=[1, 2])
    with pytest.raises(ProblemError, match="at least 1"):
        plan_many(problems, jobs=0)


def test_nothing_to_plan():
    assert list(plan_many([])) == []


def test_an_interrupted_plan_ends_all(window_problem, monkeypatch):
    many = sys.modules["rrnn_opt.planning.many"]
    problems = [Problem.from_dict(window_problem())] * 3

    def stopped(problem, *, seed):
        result = plan(problem, seed=seed)
        return replace(result, status="interrupted") if seed == 1 else result

    monkeypatch.setattr(many, "plan", stopped)
    found = plan_many(problems, jobs=1)
    assert next(found).seed == 0
    with pytest.raises(KeyboardInterrupt):
        next(found)


def test_a_failing_worker_is_heard(window_problem):
    """The option is refused wherever the plan is made; no share is lost silently."""
    problems = [Problem.from_dict(window_problem())] * 4
    with pytest.raises(ProblemError, match="budget"):
        list(plan_many(problems, jobs=2, max_explorations=0))


def test_who_stops_early_leaves_no_process_waiting(window_problem):
    problems = [Problem.from_dict(window_problem())] * 30
    found = plan_many(problems, jobs=2)
    assert [next(found).seed, next(found).seed] == [0, 1]
    found.close()
    assert list(found) == []
