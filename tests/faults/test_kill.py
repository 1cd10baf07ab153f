"""Killed at any moment: nothing torn is taken for whole, and the next run is right.

``deadly`` counts what a command does to its result folder and kills it before the
k-th of these; every k of a sample, ends included, is tried.  Other kills come at
seeded times.  ``RRNN_FAULTS=N`` multiplies the sample.
"""

import itertools
import json
import os
import random
import shutil
import signal
import time

import pytest

from benchmarks.faults.place import contents, furnished, whole

ROUNDS = int(os.environ.get("RRNN_FAULTS", "1"))
CLI, DEADLY = "rrnn_opt.cli.start", "benchmarks.faults.deadly"
PLAN = (CLI, "plan", "problem.json", "--out", "out", "--json")
GENERATE = (CLI, "generate", "minimum_velocity", "--robot", "planar3", "--out", "out")
SPHERES = (CLI, "spheres", "arm.urdf", "--out", "out/spheres.json")
COMMANDS = {"plan": PLAN, "generate": GENERATE, "spheres": SPHERES}


def sample(count, size, seed):
    """Numbers 1..count: the ends and seeded ones between, ``size`` in all."""
    inner = range(2, count)
    drawn = random.Random(seed).sample(inner, min(size - 2, len(inner)))
    return sorted({1, count, *drawn})


@pytest.mark.slow
@pytest.mark.parametrize("name", COMMANDS)
def test_killed_before_any_change_of_a_file(tmp_path, warm_cache, name):
    clean = furnished(tmp_path / "clean", warm_cache)
    count_run = clean.run(DEADLY, "0", str(clean.out), *COMMANDS[name])
    assert count_run.returncode == 0, count_run.stderr
    count = int((clean.path / "count").read_text())
    assert count >= 3
    wanted = contents(clean)
    for k in sample(count, 3 * ROUNDS, seed=count):
        place = furnished(tmp_path / str(k), warm_cache)
        words = (str(k), str(place.out), *COMMANDS[name])
        assert place.run(DEADLY, *words).returncode == -signal.SIGKILL
        seen = [p for p in place.files() if not any(q[0] == "." for q in p.split("/"))]
        assert all(whole(place.out / name) for name in seen), seen
        place.age()
        again = place.run(*COMMANDS[name])
        assert again.returncode == 0, again.stderr
        assert contents(place) == wanted
        assert place.litter() == []


@pytest.mark.slow
def test_killed_over_the_results_of_another_plan(tmp_path, warm_cache):
    """Files of two plans never stand side by side."""
    first = furnished(tmp_path / "first", warm_cache)
    assert first.run(*PLAN).returncode == 0
    problem = json.loads((first.path / "problem.json").read_text())
    problem["goal"] = {"joints": [-0.5, 0.3, 0.8]}
    (first.path / "problem.json").write_text(json.dumps(problem))
    for k in range(2, 100, max(1, 4 // ROUNDS)):
        place = furnished(tmp_path / str(k), warm_cache)
        shutil.copytree(first.path, place.path, dirs_exist_ok=True)
        words = (str(k), str(place.out), *PLAN)
        code = place.run(DEADLY, *words).returncode
        if code == 0:
            break
        rows = json.loads((place.out / "plan.json").read_text())["trajectory"]["q"]
        table = place.out / "trajectory.csv"
        if table.exists():
            last = [float(x) for x in table.read_text().splitlines()[-1].split(",")]
            assert last[1:4] == rows[-1]
    assert k > 5


@pytest.mark.slow
def test_killed_at_any_time_of_a_cold_start(tmp_path):
    """Into one shared cache, which no kill may spoil."""
    cache = tmp_path / "cache"
    clean = furnished(tmp_path / "clean", tmp_path / "own")
    begin = time.monotonic()
    assert clean.run(*PLAN).returncode == 0
    spent, rng = time.monotonic() - begin, random.Random(1)
    for k in range(3 * ROUNDS):
        place = furnished(tmp_path / str(k), cache)
        process = place.start(*PLAN)
        time.sleep(rng.uniform(0.2, 0.95) * spent)
        process.kill()
        process.communicate()
        seen = [p for p in place.files() if not p.startswith(".")]
        assert all(whole(place.out / name) for name in seen), seen
    place.age()
    again = place.run(*PLAN)
    assert again.returncode == 0, again.stderr
    assert contents(place) == contents(clean)
    assert len(list(cache.glob("planner_*.so"))) == 1
    assert place.litter() == []


@pytest.mark.slow
def test_a_killed_reproduction_is_taken_up(tmp_path, warm_cache):
    place = furnished(tmp_path / "place", warm_cache)
    words = (CLI, "reproduce", "fig3", "--trials", "2", "--jobs", "1", "--json")
    words += ("--out", "out")
    clean = furnished(tmp_path / "clean", warm_cache)
    finished = clean.run(*words)
    assert finished.returncode == 0, finished.stderr
    rng = random.Random(2)
    kept = 0
    for _ in range(ROUNDS):
        process = place.start(*words, "--resume")
        while lines_of(place.out) <= kept and process.poll() is None:
            time.sleep(0.02)
        time.sleep(rng.uniform(0.0, 0.5))
        process.kill()
        process.communicate()
        lines = lines_of(place.out)
        assert lines >= kept  # nothing that was there is lost
        kept = lines
    again = place.run(*words, "--resume")
    assert again.returncode == 0, again.stderr
    cells, wanted = (json.loads(run.stdout)["cells"] for run in (again, finished))
    assert [c["ours"] for c in cells] == [c["ours"] for c in wanted]
    assert kept > 0


def lines_of(folder):
    """Whole rows in all journals and parts."""
    texts = (p.read_bytes() for p in folder.rglob("journal.jsonl"))
    parts = sum(1 for _ in folder.rglob("part-*.parquet"))
    return sum(text.count(b"\n") for text in texts) if not parts else 10**9


SMALL_SOAK = """
import sys, benchmarks.soak.run as soak
from benchmarks.soak.scenes import cluttered
from rrnn_opt.robot import Robot
kind = {'planar3': cluttered(Robot.builtin('planar3'))}
soak.makers = lambda out: kind
sys.exit(soak.main(['--plans', '12', '--out', 'out']))
"""


@pytest.mark.slow
def test_a_killed_soak_loses_no_line(tmp_path, warm_cache):
    place = furnished(tmp_path / "place", warm_cache)
    (place.path / "small_soak.py").write_text(SMALL_SOAK)
    seen: dict[str, bytes] = {}
    rng = random.Random(3)
    for _ in range(3 * ROUNDS):
        process = place.start("small_soak")
        table = place.out / "rows.0.jsonl"
        had = table.read_bytes().count(b"\n") if table.exists() else 0
        for _ in itertools.count():
            now = table.read_bytes().count(b"\n") if table.exists() else 0
            if now > had + 1 or process.poll() is not None:
                break
            time.sleep(0.01)
        time.sleep(rng.uniform(0.0, 0.05))
        process.kill()
        process.communicate()
        table.write_bytes(table.read_bytes() + b'{"n": 11, "torn')  # in mid-write
        for number, line in numbered(table).items():
            assert seen.setdefault(number, line) == line
    assert place.run("small_soak").returncode == 0
    assert sorted(numbered(table)) == list(range(12))
    assert seen.items() <= numbered(table).items()


def numbered(table):
    found = {}
    for line in table.read_bytes().splitlines():
        if line.endswith(b"}"):
            found[json.loads(line)["n"]] = line
    return found
