"""The shipped scenarios are whole, and say that their numbers are our own."""

import pytest

from rrnn_opt.errors import ProblemError
from rrnn_opt.scene.library import SCENARIOS, scenario
from rrnn_opt.scene.reading import scene_from_list


@pytest.mark.parametrize("name", SCENARIOS)
def test_fifty_starts_a_target_and_the_source_of_the_numbers(name):
    given = scenario(name)
    assert len(set(given.starts)) == 50
    joints = 6 if given.robot == "raven2" else 7
    assert {len(start) for start in given.starts} == {joints}
    assert "choices of this project" in given.choices
    problem = given.problem(3)
    assert problem["start"] == list(given.starts[3])
    assert problem["goal"] == {"position": list(given.target), "tolerance": 0.001}
    scene = scene_from_list(problem["obstacles"])
    assert [o.name for o in scene] == [o["name"] for o in given.obstacles]


@pytest.mark.parametrize(
    ("name", "width"), [("window", 0.3), ("window_040", 0.4), ("window_050", 0.5)]
)
def test_the_boards_leave_exactly_the_window_open(name, width):
    given = scenario(name)
    boards = {o.name: o for o in scene_from_list(list(given.obstacles))}
    inner = {
        "y": [
            boards["right"].position[1] + boards["right"].size[1] / 2,
            boards["left"].position[1] - boards["left"].size[1] / 2,
        ],
        "z": [
            boards["below"].position[2] + boards["below"].size[2] / 2,
            boards["above"].position[2] - boards["above"].size[2] / 2,
        ],
    }
    for axis, (low, high) in inner.items():
        assert [low, high] == pytest.approx(given.window[axis])
        assert high - low == pytest.approx(width)
    assert all(board.position[0] == given.window["x"] for board in boards.values())
    assert given.target[0] > given.window["x"]


def test_every_window_has_the_same_starts():
    first, *others = (scenario(name) for name in SCENARIOS if "window" in name)
    assert all(other.starts == first.starts for other in others)


def test_a_problem_can_be_changed_without_changing_the_scenario():
    given = scenario("window")
    given.problem()["obstacles"][0]["position"][1] += 0.05
    assert given.problem()["obstacles"][0]["position"][1] == 0


def test_unknown_scenario_and_start():
    with pytest.raises(ProblemError, match="did you mean 'window_040'"):
        scenario("window_04")
    with pytest.raises(ProblemError, match="starts 0 to 49, not 50"):
        scenario("plane").problem(50)
    with pytest.raises(ProblemError, match="not -1"):
        scenario("plane").problem(-1)
