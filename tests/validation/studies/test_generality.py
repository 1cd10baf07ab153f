"""The study of random scenes counts what its rows say, and goes on."""

import os

import pytest

from rrnn_opt.errors import RrnnError
from rrnn_opt.planning import Problem
from rrnn_opt.robot import Robot
from rrnn_opt.validation.studies import generality
from rrnn_opt.validation.studies.clutter import OBSTACLES, scenes
from rrnn_opt.validation.studies.generality_page import HEADER, kept_lines, page
from rrnn_opt.validation.studies.peer import rrt_connect

ROW = {"arm": "a", "joints": 6, "spheres": 9, "plan_s": 1e-3, "all_s": 1e-2}
ROW |= {"peer_s": 2e-3, "status": "solved", "peer": True}


def test_the_page_tells_who_solved_what():
    lost = {**ROW, "status": "budget_exhausted"}
    rows = [ROW, {**ROW, "peer": False}, lost, {**lost, "peer": False}]
    touch = {"postures": 10, "spheres": 0.3, "geometry": 0.1}
    contacts = {"a": {"before": touch, "after": {**touch, "spheres": 0.2}}}
    made = ["0ld", "0ld", "new", "new"]
    numbered = [{**row, "scene": k, "commit": made[k]} for k, row in enumerate(rows)]
    text = page(numbered, "command", contacts, (2000, 6.0))
    line = next(line for line in text.splitlines() if line.startswith("| a |"))
    cells = [cell.strip() for cell in line.strip("|").split("|")]
    assert cells[3] == "2/4"
    assert cells[7] == "2 budget_exhausted"
    assert (cells[8], cells[10]) == ("2/4", "1")
    assert cells[11] == "0ld, new"
    assert "- a, only RRTConnect found a path: 1 (2)" in text
    assert "- a, neither did: 1 (3)" in text
    assert "- a, only we did: 1 (1)" in text
    assert "| a | 10 | 30.0% | 20.0% | 10.0% |" in text


def test_lines_of_an_earlier_page_name_its_commit():
    cells = ["x"] * (len(HEADER) - 2)
    lines = ["| " + " | ".join([arm, *cells]) + " |" for arm in ("arm", "a", "b")]
    text = kept_lines("\n".join([*lines, "| c | too few |"]), "0ld", ["a"])
    found = [line for line in text.splitlines() if line.startswith("| ")]
    assert [line.split(" | ")[0] for line in found] == ["| arm", "| ---", "| b"]
    assert found[-1].endswith("| x | 0ld |")
    assert len({line.count("|") for line in found}) == 1
    assert kept_lines("\n".join(lines), "0ld", ["a", "b"]) == ""


def test_scenes_are_those_of_their_seed():
    robot = Robot.builtin("pa10")
    one, two = (list(scenes(robot, 2, seed=5)) for _ in range(2))
    for a, b in zip(one, two, strict=True):
        assert a.to_dict() == b.to_dict()
        assert len(a.scene) == OBSTACLES
    assert one[0].to_dict() != next(scenes(robot, 1, seed=6)).to_dict()


def test_a_stopped_study_goes_on(tmp_path, monkeypatch):
    robot, asked = Robot.builtin("pa10"), []
    monkeypatch.setattr(generality, "arm", lambda name, out: robot)

    def measured(name: str, index: int, problem: Problem, peer: bool):
        asked.append(index)
        return {**ROW, "arm": name, "scene": index}

    monkeypatch.setattr(generality, "measured", measured)
    first = list(generality.run(["pa10"], tmp_path, 2, seed=1))
    both = list(generality.run(["pa10"], tmp_path, 3, seed=1))
    assert asked == [0, 1, 2]
    assert both[:2] == first


def test_the_page_has_every_arm_of_the_folder(tmp_path, monkeypatch):
    """Arms run one by one, in different numbers of scenes, make one page."""
    robot = Robot.builtin("pa10")
    monkeypatch.setattr(generality, "arm", lambda name, out: robot)
    monkeypatch.setattr(generality, "commit", lambda: "abc123")

    def measured(name: str, index: int, problem: Problem, peer: bool):
        return {**ROW, "arm": name, "scene": index}

    monkeypatch.setattr(generality, "measured", measured)
    for name, count in (("kinova", "3"), ("ur10", "2")):
        words = ["--arms", name, "--scenes", count, "--out", str(tmp_path)]
        assert generality.main(words) == 0
    text = (tmp_path / "generality.md").read_text("utf-8")
    found = [line for line in text.splitlines() if line.startswith(("| ur", "| ki"))]
    assert [line.split(" | ")[3] for line in found] == ["2/2", "3/3"]
    assert all(line.endswith("| abc123 |") for line in found)


def test_rrt_connect_reaches_a_goal_and_counts_its_checks():
    pytest.importorskip("ompl", reason="the extra test brings ompl")
    problem = next(scenes(Robot.builtin("pa10"), 1, seed=5))
    goal = problem.goals[0].joints
    run = rrt_connect(problem, goal, 10.0)
    assert run.solved
    assert run.checks > 10
    assert 0.0 < run.seconds < run.cpu_s


@pytest.mark.parametrize("name", ["no-such-commit", "--output=stolen", "a\0b"])
def test_an_earlier_page_that_is_not_there_is_one_sentence(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    for path in (os.environ["PATH"], str(tmp_path)):  # with git, and without
        monkeypatch.setenv("PATH", path)
        with pytest.raises(RrnnError, match="leave --earlier out") as caught:
            generality.earlier_page(name)
        assert "\n" not in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def test_the_earlier_page_is_asked_for_before_the_work(tmp_path):
    with pytest.raises(RrnnError, match="no page of that commit"):
        generality.main(["--earlier", "none", "--out", str(tmp_path / "out")])
    assert not (tmp_path / "out").exists()
