"""Refinement: shorter, same ends, still proved, and decided by the seed."""

import itertools
import time
from types import SimpleNamespace

import numpy as np
import pytest

from rrnn_opt.errors import ProblemError
from rrnn_opt.planning import Problem, RandomRnn, plan
from rrnn_opt.planning.search.refine import length, refine
from rrnn_opt.scene.library import scenario


def solved(search):
    status = "paused"
    while status == "paused":
        status = search.run(20_000, 10.0)
    assert status == "solved"
    return search.path()


def test_slides_shorten_and_keep_ends_and_proofs(
    pa10_runtime, window_problem, open_search
):
    start = scenario("window").problem(42)["start"]  # a hard one
    problem, gains = Problem.from_dict(window_problem(start=start)), []
    for seed in range(6):
        with open_search(pa10_runtime, problem, seed=seed) as search:
            raw = solved(search)
            short = search.shorten(raw, 40)
            np.testing.assert_array_equal(short[[0, -1]], raw[[0, -1]])
            assert length(short) <= length(raw) + 1e-9
            pieces = itertools.pairwise(short)
            assert all(search.segment_free(a, b) for a, b in pieces)
            gains.append(length(short) / length(raw))
    assert np.mean(gains) < 0.9


@pytest.mark.parametrize("count", [0, 3])
def test_refine_takes_the_shortest(pa10_runtime, window_problem, open_search, count):
    problem, settings = (
        Problem.from_dict(window_problem()),
        RandomRnn(refinements=count),
    )

    def another(number):
        return open_search(pa10_runtime, problem, seed=100 + number)

    def refined():
        with open_search(pa10_runtime, problem, seed=1) as search:
            raw = solved(search)
            path = refine(search, another, settings, 1).path
            pieces = itertools.pairwise(path)
            assert all(search.segment_free(a, b) for a, b in pieces)
            return raw, path

    (raw, path), (_, again) = refined(), refined()
    np.testing.assert_array_equal(path, again)
    np.testing.assert_array_equal(path[0], problem.start)
    assert length(path) <= length(raw)


def test_a_segment_with_clearance_is_harder(pa10_runtime, window_problem, open_search):
    problem = Problem.from_dict(window_problem())
    with open_search(pa10_runtime, problem) as search:
        gap = search.closest(problem.start, radius=0.5).gap
        same = problem.start + 1e-6
        assert search.segment_free(problem.start, same, extra=0.9 * gap)
        assert not search.segment_free(problem.start, same, extra=1.1 * gap)


def test_improving_goes_on_until_its_seconds_are_spent(window_problem, monkeypatch):
    """Seconds of CPU here, so that others on the machine take none of them."""
    clock = SimpleNamespace(perf_counter=time.process_time)
    monkeypatch.setattr("rrnn_opt.planning.search.refine.time", clock)
    problem = Problem.from_dict(
        window_problem(start=scenario("window").problem(42)["start"])
    )
    settings = RandomRnn(refinements=0)
    first = plan(problem, seed=2, settings=settings)
    begin = time.process_time()
    better = plan(problem, seed=2, settings=settings, improve_s=0.5)
    assert time.process_time() - begin < 5.0
    assert first.stats.refinements == 0
    assert better.stats.refinements > 3
    assert better.solved
    assert better.stats.first_path_length == first.stats.first_path_length
    assert better.stats.path_length < first.stats.path_length
    assert better.stats.path_length == pytest.approx(length(better.path))
    assert better.stats.refine_time_s >= 0.5
    with pytest.raises(ProblemError, match="improve"):
        plan(problem, improve_s=-1.0)


def test_no_search_where_none_can_help(window_problem):
    """A joint goal across free space is reached nearly straight: nothing is left."""
    start = Problem.from_dict(window_problem()).start
    goal = (start + 0.3 * np.cos(np.arange(len(start)))).tolist()
    free = window_problem(goal={"joints": goal}, obstacles=[])
    result = plan(Problem.from_dict(free))
    assert result.solved
    assert result.stats.refinements == 0
    apart = np.linalg.norm(np.subtract(goal, start))
    assert result.stats.path_length <= 1.02 * apart


def test_a_search_that_repeats_the_first_is_the_last(
    pa10_runtime, window_problem, open_search
):
    problem, made = Problem.from_dict(window_problem()), []

    def same(number):
        made.append(number)
        return open_search(pa10_runtime, problem, seed=1)

    with open_search(pa10_runtime, problem, seed=1) as search:
        raw = solved(search)
        refined = refine(search, same, RandomRnn(refinements=3), 1)
    assert made == [1]
    assert refined.rounds == 1
    assert refined.first_length == length(raw)
