import csv
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest


def only_document(shown) -> dict:
    """Standard output holds exactly one line of JSON and nothing else."""
    assert shown.stdout.count("\n") == 1
    return json.loads(shown.stdout)


def one_sentence(shown) -> str:
    assert shown.stderr.count("\n") == 1, shown.stderr
    assert shown.stderr.startswith("rrnn: ")
    return shown.stderr


def test_a_solved_problem_leaves_four_files_that_agree(
    rrnn, program, problem, tmp_path
):
    shown = program("plan", problem(), "--json", "--out", "out", "--seed", "3")
    assert shown.returncode == 0, shown.stderr
    document = only_document(shown)
    assert document["status"] == "solved"
    assert document["seed"] == 3
    out = tmp_path / "out"
    names = {"plan.json", "trajectory.csv", "plan.png", "plan.html"}
    assert {p.name for p in out.iterdir()} == names
    assert json.loads((out / "plan.json").read_text()) == document
    with (out / "trajectory.csv").open(newline="") as file:
        rows = list(csv.reader(file))
    assert rows[0] == ["t"] + [f"{b}{k}" for b in ("q", "qd", "qdd") for k in (1, 2, 3)]
    assert len(rows) == 1 + len(document["trajectory"]["t"])
    checked = rrnn("check", "out/plan.json", "--json")
    assert checked.returncode == 0
    assert only_document(checked)["holds"] is True
    exact = only_document(rrnn("check", "out/plan.json", "--exact", "--json"))
    assert exact["holds"] is True
    assert "ball arithmetic" in exact["certificate"]["method"]


def test_the_same_seed_gives_the_same_plan_in_any_process(rrnn, program, problem):
    """The same document but for its times."""

    def without_times(value):
        if isinstance(value, dict):
            items = value.items()
            return {k: without_times(v) for k, v in items if not k.endswith("_s")}
        return value

    name = problem()
    first, second = (run("plan", name, "--json") for run in (rrnn, program))
    one, two = (without_times(only_document(s)) for s in (first, second))
    assert one == two


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"start": [0.0, float("nan"), 0.5]}, "start"),
        ({"start": [0.0, 0.5]}, "start"),
        ({"start": [9.0, 0.0, 0.0]}, "start"),
        ({"robot": "pa11"}, "pa10"),
        ({"frame": "nowhere"}, "frame"),
        ({"obstacle": []}, "obstacle"),
    ],
)
def test_a_bad_problem_is_named_in_one_sentence(rrnn, problem, fields, said):
    shown = rrnn("plan", problem(**fields), "--json")
    assert shown.returncode == 2
    document = only_document(shown)
    assert document["status"] == "invalid_problem"
    assert said in document["message"]
    assert said in one_sentence(shown)


def test_a_start_in_collision_is_infeasible(rrnn, problem):
    ball = {"name": "ball", "type": "sphere", "radius": 0.3, "position": [1.5, 0.7, 0]}
    shown = rrnn("plan", problem(obstacles=[ball]), "--json")
    assert shown.returncode == 1
    assert only_document(shown)["status"] == "infeasible"


def test_no_compiler_is_said_in_one_sentence(program, problem, tmp_path):
    env = {"CC": "", "PATH": str(tmp_path), "RRNN_CACHE_DIR": str(tmp_path / "c")}
    hidden = tmp_path / "ziglang.py"
    hidden.write_text("raise ImportError")
    shown = program("plan", problem(), "--json", PYTHONPATH=str(tmp_path), **env)
    assert shown.returncode == 2
    assert only_document(shown)["status"] == "invalid_problem"
    assert "apt install gcc" in one_sentence(shown)


@pytest.mark.parametrize(
    "words",
    [
        ("missing.json",),
        ("problem.json", "--planner", "magic"),
        ("problem.json", "--time-limit", "-1"),
        ("problem.json", "--time-limit", "nan"),
        ("problem.json", "--max-explorations", "0"),
        ("problem.json", "--seed", "-1"),
        ("problem.json", "--nonsense"),
        (),
    ],
)
def test_a_wrong_command_line_gives_a_document_too(rrnn, problem, words):
    problem()
    shown = rrnn("plan", *words, "--json")
    assert shown.returncode == 2
    assert only_document(shown)["status"] == "invalid_problem"
    one_sentence(shown)


def test_a_folder_that_cannot_be_made_is_refused_before_planning(rrnn, problem):
    shown = rrnn("plan", problem(), "--json", "--out", "problem.json/out")
    assert shown.returncode == 2
    assert "--out" in only_document(shown)["message"]


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")
def test_a_full_standard_output_is_no_traceback():
    command = [sys.executable, "-m", "rrnn_opt.cli.main", "robots", "--json"]
    with open("/dev/full", "w") as full:
        shown = subprocess.run(
            command, stdout=full, stderr=subprocess.PIPE, text=True, check=False
        )
    assert shown.returncode in (1, 2)
    assert "Traceback" not in shown.stderr
    assert "No space left" in shown.stderr


def wait_for_the_search(process: subprocess.Popen) -> None:
    """Until the compiled search is loaded, however slow the machine is."""
    maps, late = Path(f"/proc/{process.pid}/maps"), time.monotonic() + 60.0
    while os.environ["RRNN_CACHE_DIR"] not in maps.read_text():
        assert process.poll() is None, process.communicate()
        assert time.monotonic() < late
        time.sleep(0.05)
    time.sleep(0.2)


@pytest.mark.skipif(not os.path.exists("/proc/self/maps"), reason="needs /proc")
def test_ctrl_c_ends_with_130_and_a_document(problem, tmp_path):
    # the first link always sweeps this ball: there is no path, and no proof of it
    ball = {"name": "post", "type": "sphere", "radius": 0.2, "position": [0, 0.5, 0]}
    goal = {"joints": [2.8, 0.1, 0.1]}
    command = [sys.executable, "-m", "rrnn_opt.cli.main", "plan"]
    words = [problem(goal=goal, obstacles=[ball]), "--json"]
    process = subprocess.Popen(
        [*command, *words, "--max-explorations", "100000000"],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    wait_for_the_search(process)
    process.send_signal(signal.SIGINT)
    shown, said = process.communicate(timeout=30)
    # Python ends by the signal itself where it interrupted an exec(), as that of
    # a dataclass being made; shells call both ends 130
    assert process.returncode in (130, -signal.SIGINT), said
    assert json.loads(shown)["status"] == "interrupted"
    assert "Traceback" not in said


@pytest.mark.slow
def test_a_spent_budget_is_said_and_drawn(rrnn, problem, tmp_path):
    ball = {"name": "post", "type": "sphere", "radius": 0.2, "position": [0, 0.5, 0]}
    name = problem(goal={"joints": [2.8, 0.1, 0.1]}, obstacles=[ball])
    shown = rrnn("plan", name, "--json", "--max-explorations", "20", "--out", "o")
    assert shown.returncode == 1
    document = only_document(shown)
    assert document["status"] == "budget_exhausted"
    assert document["stats"]["explorations"] == 20
    names = {"plan.json", "plan.png", "plan.html"}
    assert {p.name for p in (tmp_path / "o").iterdir()} == names
