import numpy as np
import pytest

from rrnn_opt.planning import Problem, plan
from rrnn_opt.report.plan.drawing import drawing_of
from rrnn_opt.report.plan.pose import joint_frames, tip_positions
from rrnn_opt.report.plan.traces import PIECES, tool_traces
from rrnn_opt.scene.library import scenario


def with_trees(document: dict) -> dict:
    start, through, end = document["path"]
    trees = {
        "start": {"q": [start, through], "parents": [-1, 0]},
        "goal": {"q": [end], "parents": [-1]},
    }
    return {**document, "trees": trees}


def test_a_trace_goes_from_a_parent_to_its_child(window):
    document = with_trees(window)
    traces = tool_traces(document)
    assert list(traces) == ["start"]  # a root alone leaves no trace
    pieces = traces["start"]
    assert pieces.shape == (PIECES, 2, 3)
    frames = joint_frames(document["robot"], document["path"][:2])
    ends = tip_positions(document["robot"], frames)
    assert np.allclose(pieces[0, 0], ends[0])
    assert np.allclose(pieces[-1, 1], ends[1])
    assert np.allclose(pieces[1:, 0], pieces[:-1, 1])


def test_without_trees_nothing_is_drawn(window):
    assert drawing_of(window).traces == {}


def test_the_planner_hands_its_trees_out_only_when_asked():
    problem = Problem.from_dict(scenario("window_040").problem(0))
    bare = plan(problem, seed=0).to_dict()
    document = plan(problem, seed=0, keep_trees=True).to_dict()
    assert "trees" not in bare
    assert bare["path"] == document["path"]  # asking changes nothing
    start, goal = document["trees"]["start"], document["trees"]["goal"]
    assert start["q"][0] == document["problem"]["start"]
    assert len(start["q"]) + len(goal["q"]) == document["stats"]["nodes"]
    for tree in (start, goal):
        assert all(p < i for i, p in enumerate(tree["parents"]))
        assert tree["parents"][0] == -1
    assert set(drawing_of(document).traces) <= {"start", "goal"}


@pytest.mark.parametrize("planner", ["paper", "method1"])
def test_the_printed_planner_has_one_tree(planner):
    problem = Problem.from_dict(scenario("plane").problem(0))
    result = plan(problem, planner=planner, max_explorations=2, keep_trees=True)
    assert len(result.trees["start"]["q"]) >= 1
    assert result.trees["goal"]["q"] == []
