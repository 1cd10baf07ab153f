"""Tables III and IV: starts, judgements, resuming, and the paired gain."""

import numpy as np
import pytest

from rrnn_opt.errors import RrnnError
from rrnn_opt.planning import Problem, plan
from rrnn_opt.scene.library import scenario
from rrnn_opt.study import Case
from rrnn_opt.validation.tables import table_3, table_4
from rrnn_opt.validation.tables.cell import judged, markdown
from rrnn_opt.validation.tables.collect import collect
from rrnn_opt.validation.tables.searched import searched
from rrnn_opt.validation.tables.starts import IN_FRONT, drawn_starts, start_problem
from rrnn_opt.validation.tables.trials import TRIALS, PlanningTrials


def row(scene, planner, trial, solved=True, total=3):
    where = {"scenario": scene, "planner": planner, "trial": trial}
    counts = {"random": total - 1, "heuristic": 1, "total": total}
    return {**where, **counts, "solved": solved, "plan_ms": 1.0}


def test_drawn_starts_are_free_in_front_and_nested():
    import rrnn_opt as rr

    few, more = drawn_starts("window", 4), drawn_starts("window", 8)
    np.testing.assert_array_equal(more[:4], few)
    robot = rr.Robot.builtin("pa10")
    tip = rr.Kinematics(robot).functions()["position"]
    assert all(float(tip(q)[0]) < IN_FRONT for q in more)
    assert len(np.unique(more[:, 0])) == 8
    assert start_problem("window", 3)["start"] == list(scenario("window").starts[3])
    assert start_problem("window", 51)["start"] == more[1].tolist()


@pytest.mark.parametrize(
    ("ours", "interval", "larger", "verdict"),
    [
        (0.95, (0.9, 1.0), True, "reproduced"),
        (0.5, (0.4, 0.6), True, "not reproduced"),
        (7.0, (6.0, 8.0), False, "better"),
        (99.0, (90.0, 110.0), False, "not reproduced"),
    ],
)
def test_judgement(ours, interval, larger, verdict):
    paper = 0.92 if larger else 58.18
    assert judged(paper, ours, interval, larger_is_better=larger) == verdict


def test_cells_of_table_3():
    rows = [row("window", "random-rnn", i) for i in range(50)]
    rows += [row("window", "paper", i, solved=i < 2) for i in range(50)]
    rows += [row("window", "no-learning", i) for i in range(50)]
    first, second = table_3.cells(rows, "command")
    assert (first.column, first.verdict) == ("paper", "cannot be reproduced as printed")
    assert (second.ours, second.verdict, second.n) == (1.0, "reproduced", 50)
    assert second.interval[0] == pytest.approx(0.9287, abs=1e-3)
    assert second.to_dict()["interval"] == list(second.interval)
    text = table_3.page(rows, "command")
    assert "| scenario 2 (window) | no-learning | - | 100.0% |" in text


def test_gain_is_paired():
    """With the pairs kept a constant factor has an interval without width."""
    totals = np.random.default_rng(1).integers(1, 40, 60).astype(float)
    ratio, low, high = table_4.gain(2 * totals, totals)
    assert (ratio, low, high) == pytest.approx((2.0, 2.0, 2.0))
    rows = [row("window", "random-rnn", i, total=4) for i in range(5)]
    rows += [row("window", "no-learning", i, total=6) for i in range(5)]
    assert "| window | no-learning / random-rnn | 1.947 | 1.5 |" in table_4.gains(rows)
    cell = next(c for c in table_4.cells(rows, "c") if c.column == "random-rnn Total")
    assert (cell.paper, cell.ours, cell.verdict) == (58.18, 4.0, "better")


def test_a_run_goes_on_where_it_stopped(tmp_path):
    """The first trial is not run again: its time is that of the first run."""
    few, more = (
        PlanningTrials(trials=n, planners=("random-rnn",), scenarios=("plane",))
        for n in (1, 2)
    )
    (kept,) = collect(few, tmp_path)
    first, second = collect(more, tmp_path)
    assert first == kept
    assert second["solved"] is True
    assert second["total"] == second["random"] + second["heuristic"]
    assert collect(more, tmp_path) == [first, second]


class OneFails:
    """Three cases, the second of which cannot be measured."""

    name = "one_fails"

    def __iter__(self):
        return iter([Case("a"), Case("b"), Case("c")])

    def measure(self, case, rng):
        if case.key == "b":
            raise RrnnError("no such start")
        return {"total": 1}


def test_no_table_is_made_of_what_is_left_of_a_study(tmp_path):
    with pytest.raises(RrnnError, match=r"1 of 3 .* failed; the first, b: .*start"):
        collect(OneFails(), tmp_path)


def test_markdown():
    assert markdown(("a", "b"), [(1.23456, None)]) == (
        "| a | b |\n| --- | --- |\n| 1.235 | - |"
    )


@pytest.mark.parametrize("name", ["random-rnn", "paper, I = failure"])
def test_the_search_that_is_timed_is_the_one_that_is_planned(name):
    problem = Problem.from_dict(start_problem("plane", 3))
    row = searched(problem, TRIALS[name], 3, 60)
    result = plan(problem, seed=3, settings=TRIALS[name], max_explorations=60)
    assert row["random"] == result.stats.random
    assert row["heuristic"] == result.stats.heuristic
    assert row["solved"] == (result.path is not None)
