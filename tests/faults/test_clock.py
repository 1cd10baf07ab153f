"""A clock that jumps changes nothing: spans are measured on one that cannot."""

import ast
import itertools
import os
import time
from pathlib import Path

import pytest

from rrnn_opt.emit import build, load
from rrnn_opt.planning import Problem, plan
from rrnn_opt.report import write_text
from tests.faults.conftest import HERE, PROBLEM
from tests.faults.test_compilers import SOURCE

AGES = {"rrnn_opt/emit/cache.py", "rrnn_opt/report/files.py"}
AGES |= {"rrnn_opt/embedding/placing.py"}
"""Where the wall clock is right: the age of a file that someone left."""
WALL = {("time", "time"), ("time", "time_ns")}
DATES = {"now", "today", "utcnow"}


def wall_clock_calls(path):
    """Calls of the wall clock in a file; a date that is only printed is none."""
    text = path.read_text("utf-8")
    if not any(word in text for word in ("time.time", "from time", "datetime")):
        return
    tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module == "time":
            assert not {a.name for a in node.names} & {"time", "time_ns"}, path
        called = isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name)
        if called and (node.value.id, node.attr) in WALL:
            yield node.lineno
        if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add | ast.Sub):
            sides = (node.left, node.right)
            if any(
                isinstance(s, ast.Call)
                and isinstance(s.func, ast.Attribute)
                and s.func.attr in DATES
                for s in sides
            ):
                yield node.lineno


def test_no_span_is_measured_on_the_wall_clock():
    found = {}
    for room in ("rrnn_opt", "formulations", "validation", "benchmarks"):
        for path in (HERE / room).rglob("*.py"):
            name = str(path.relative_to(HERE))
            lines = list(wall_clock_calls(path))
            if lines and name not in AGES:
                found[name] = lines
    assert found == {}


def test_the_runtime_asks_clocks_that_do_not_jump():
    texts = [p.read_text() for p in (HERE / "rrnn_opt/planning/runtime").glob("*.[ch]")]
    assert any("CLOCK_" in text for text in texts)
    for text in texts:
        assert "CLOCK_REALTIME" not in text
        assert "gettimeofday" not in text
        assert "time(NULL)" not in text


@pytest.mark.parametrize("step", [-3600.0, 3600.0], ids=["back", "ahead"])
def test_a_time_limit_holds_while_the_clock_jumps(monkeypatch, step):
    ticks = itertools.count()
    monkeypatch.setattr(time, "time", lambda: 1e9 + step * next(ticks))
    ball = {"name": "post", "type": "sphere", "radius": 0.2, "position": [0, 0.5, 0]}
    goal = {"joints": [2.8, 0.1, 0.1]}  # the first link always sweeps the ball
    problem = Problem.from_dict(PROBLEM | {"goal": goal, "obstacles": [ball]})
    plan(problem, max_explorations=1)  # compiled now
    begin = time.monotonic()
    result = plan(problem, time_limit=0.3, max_explorations=10**8)
    assert result.status == "time_limit"
    assert time.monotonic() - begin < 20.0
    assert 0.0 <= result.to_dict()["stats"]["time_s"] < 20.0


def test_entries_and_leftovers_from_the_future(tmp_path, monkeypatch):
    monkeypatch.setenv("RRNN_CACHE_DIR", str(tmp_path))
    path = build(SOURCE, name="answer").path
    left = tmp_path / ".new-left.tmp"
    left.write_text("half")
    for file in (path, left):
        os.utime(file, (4e9, 4e9))
    assert build(SOURCE, name="answer").cached
    build(SOURCE + " ", name="answer")  # sweeps, and leaves what is young
    assert left.exists()
    assert load(path).the_answer() == 42


def test_leftovers_of_killed_runs_go_with_time(tmp_path, monkeypatch):
    temporary = tmp_path / "tmp"
    temporary.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(temporary))
    monkeypatch.setenv("RRNN_CACHE_DIR", str(tmp_path / "cache"))
    old, young, foreign = (temporary / n for n in ("rrnn_opt-a", "rrnn_opt-b", "x"))
    for folder in (old, young, foreign):
        folder.mkdir()
        (folder / "tu.c").write_text("int x;")
    for folder in (old, foreign):
        os.utime(folder, (0, 0))
    (temporary / "rrnn_opt-link").symlink_to(foreign)
    os.utime(temporary / "rrnn_opt-link", (0, 0), follow_symlinks=False)
    build(SOURCE + "// of this test alone\n", name="answer")
    assert {p.name for p in temporary.iterdir()} == {"rrnn_opt-b", "rrnn_opt-link", "x"}
    assert (foreign / "tu.c").exists()
    torn = tmp_path / ".plan.json.abcdefgh"
    other = tmp_path / ".plan.jsonl.abcdefgh"
    for file in (torn, other):
        file.write_text("half")
        os.utime(file, (0, 0))
    assert write_text(tmp_path / "plan.json", "{}\n") == Path(tmp_path / "plan.json")
    assert other.exists()
    assert not torn.exists()


def test_the_zone_of_the_clock_changes_nothing(monkeypatch):
    told = []
    for zone in ("UTC", "Asia/Kathmandu", "America/St_Johns"):
        monkeypatch.setenv("TZ", zone)
        time.tzset()
        told.append(plan(Problem.from_dict(PROBLEM)).to_dict()["path"])
    monkeypatch.undo()
    time.tzset()
    assert told[0] == told[1] == told[2]
