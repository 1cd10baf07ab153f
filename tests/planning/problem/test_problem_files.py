"""Problem files: paths in them, benchmark families, and mutations of a document."""

import copy
import json
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.errors import DocumentError, ProblemError, RobotError
from rrnn_opt.planning.problem.goals import JointGoal
from rrnn_opt.planning.problem.problem import Problem
from rrnn_opt.robot.robot import Robot
from tests.planning.problem.documents import minimal, one_joint, valid

FAMILIES = sorted((Path(__file__).parents[2] / "data" / "mbm").glob("*.json"))


def test_files_are_sought_beside_the_problem_file(tmp_path, monkeypatch):
    asked = {}

    def from_urdf(path, **options):
        asked.update(path=path, **options)
        return one_joint("revolute", -1, 1)

    monkeypatch.setattr(Robot, "from_urdf", staticmethod(from_urdf))
    (tmp_path / "arm").mkdir()
    for file in ("arm/one.urdf", "balls.json"):
        (tmp_path / file).write_text("")
    data = minimal() | {"robot": "arm/one.urdf", "spheres": "balls.json"}
    data |= {"frame": "tip", "locked": {"finger": 0.02}, "start": [0]}
    file = tmp_path / "p.json"
    file.write_text(json.dumps(data))
    problem = Problem.load(file)
    assert asked == {
        "path": tmp_path / "arm/one.urdf",
        "tip": "tip",
        "spheres": tmp_path / "balls.json",
        "locked": {"finger": 0.02},
    }
    written = problem.to_dict()
    assert (written["robot"], written["spheres"]) == ("arm/one.urdf", "balls.json")
    assert written["locked"] == {"finger": 0.02}
    (tmp_path / "balls.json").unlink()
    with pytest.raises(ProblemError, match="spheres: there is no file"):
        Problem.load(file)


@pytest.mark.parametrize("file", FAMILIES, ids=lambda f: f.stem)
def test_benchmark_problems_load(file):
    problem = Problem.load(file)
    assert problem.robot.name == "panda"
    assert isinstance(problem.goals[0], JointGoal)
    assert len(problem.scene) == len(json.loads(file.read_text())["obstacles"])


def test_there_is_a_benchmark_problem_of_each_family():
    assert [f.stem for f in FAMILIES] == [
        "bookshelf_small",
        "bookshelf_tall",
        "box",
        "table_pick",
        "table_under_pick",
    ]


JUNK = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.just(10**400),
    st.floats(),
    st.text(max_size=8),
    st.sampled_from(["box", "mesh", "pa10", "planar3", "..", "/", "x.urdf", "tip"]),
    st.lists(st.floats(), max_size=4),
    st.lists(st.none(), max_size=2),
    st.dictionaries(st.text(max_size=5), st.floats(), max_size=2),
    st.just({1: 2}),
    st.just({"joints": [0, 0, 0]}),
)


def places(value, path=()):
    """Paths of all entries inside nested dicts and lists."""
    if isinstance(value, dict | list):
        keys = value.keys() if isinstance(value, dict) else range(len(value))
        for key in list(keys):
            yield (*path, key)
            yield from places(value[key], (*path, key))


@settings(max_examples=200)
@given(st.data())
def test_mutated_problems_are_read_or_refused(data):
    problem = copy.deepcopy(valid())
    for _ in range(data.draw(st.integers(1, 3))):
        where = list(places(problem))
        if not where:
            break
        *path, key = data.draw(st.sampled_from(where))
        at = problem
        for step in path:
            at = at[step]
        action = data.draw(st.sampled_from(["replace", "delete", "add"]))
        if action == "replace":
            at[key] = copy.deepcopy(data.draw(JUNK))
        elif action == "delete":
            del at[key]
        elif isinstance(at, dict):
            at[data.draw(st.text(max_size=8))] = copy.deepcopy(data.draw(JUNK))
        else:
            at.append(copy.deepcopy(data.draw(JUNK)))
    written, refusal = outcome(problem)
    assert "\n" not in refusal
    if not refusal:
        json.dumps(written, allow_nan=False)
        assert outcome(written) == (written, "")


def outcome(data):
    try:
        return Problem.from_dict(data).to_dict(), ""
    except (ProblemError, DocumentError, RobotError) as error:
        return None, str(error)
