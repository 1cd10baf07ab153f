"""Disks that are full, read-only or limited: one sentence, and no result lost."""

import contextlib
import json
import shutil
import subprocess
import sys

import pytest

from rrnn_opt.report import write_text
from rrnn_opt.study import Lines
from tests.faults.conftest import PROBLEM, furnished


@contextlib.contextmanager
def mounted(folder, options):
    """A small file system; permissions do not bind the superuser, mounts do."""
    folder.mkdir()
    words = ["mount", "-t", "tmpfs", "-o", options, "none", str(folder)]
    if shutil.which("mount") is None:
        pytest.skip("needs the program mount")
    if subprocess.run(words, capture_output=True, check=False).returncode != 0:
        pytest.skip("needs the right to mount a tmpfs")
    try:
        yield folder
    finally:
        subprocess.run(["umount", "-l", str(folder)], check=True)


def one_sentence(run):
    assert "Traceback" not in run.stderr
    lines = [line for line in run.stderr.splitlines() if line.startswith("rrnn: ")]
    assert len(lines) == 1, run.stderr
    return lines[0]


@pytest.mark.slow
def test_a_full_disk_keeps_the_plan_on_standard_output(place):
    with mounted(place.out, "size=8k") as full:
        run = place.rrnn("plan", "problem.json", "--out", "out", "--json")
        left = sorted(path.name for path in full.iterdir())
    assert run.returncode == 1
    assert json.loads(run.stdout)["status"] == "solved"
    assert "No space left" in one_sentence(run)
    assert "another disk" in run.stderr
    assert not [name for name in left if name.startswith(".")]  # nothing half-written


def test_a_full_disk_keeps_the_files_that_were_there(tmp_path):
    with mounted(tmp_path / "disk", "size=16k") as full:
        path = write_text(full / "plan.json", "before\n")
        with pytest.raises(OSError, match="No space left") as caught:
            write_text(path, "x" * 20_000)
        assert caught.value.filename == str(path)
        assert path.read_text() == "before\n"
        lines = Lines(full / "rows.jsonl")
        lines.append({"n": 0})
        with pytest.raises(OSError, match="No space left"):
            lines.append({"n": 1, "text": "x" * 20_000})
        lines.append({"n": 2})
        assert [row["n"] for row in lines] == [0, 2]


RESULTS = {
    "simulate": (
        ("simulate", "closed_loop", "--robot", "planar3", "--task", "task.toml"),
        lambda document: document["rms_error_m"] < 1e-2,
    ),
    "verify": (
        ("verify", "C1", "C2"),
        lambda document: [row["id"] for row in document["claims"]] == ["C1", "C2"],
    ),
}
TASK = """
[task]
kind = "circle"
radius = 0.05
period = 1.0
plane = "xy"
through = "start"

[robot]
q0 = [0.3, 0.6, 0.5]
"""


@pytest.mark.slow
@pytest.mark.parametrize("name", RESULTS)
def test_a_full_disk_keeps_results_on_standard_output(place, name):
    words, right = RESULTS[name]
    (place.path / "task.toml").write_text(TASK)
    with mounted(place.out, "size=4k") as full:
        run = place.rrnn(*words, "--out", "out", "--json")
        left = [path for path in full.iterdir() if path.stat().st_size]
    assert run.returncode == 1
    assert right(json.loads(run.stdout))
    assert "No space left" in run.stderr.splitlines()[-1]
    assert "Traceback" not in run.stderr
    assert left == []


STUDY = ("reproduce", "fig3", "--trials", "2", "--jobs", "1", "--out", "out")


@pytest.mark.slow
def test_a_study_goes_on_once_the_disk_has_room(place):
    with mounted(place.out, "size=24k") as small:
        run = place.rrnn(*STUDY)
        assert run.returncode == 1
        assert "No space left" in one_sentence(run)
        shutil.copytree(small, place.path / "kept")
    shutil.rmtree(place.out)
    (place.path / "kept").rename(place.out)
    assert place.rrnn(*STUDY, "--resume").returncode == 0
    assert (place.out / "fig3.png").stat().st_size > 0


@pytest.mark.slow
@pytest.mark.parametrize(
    "words",
    [("demo", "--out", "out"), ("view", "plan.json", "--out", "out/plan.html")],
    ids=["demo", "view"],
)
def test_a_full_disk_leaves_no_half_page(place, words):
    assert place.rrnn("plan", "problem.json", "--out", ".").returncode == 0
    with mounted(place.out, "size=4k") as full:
        run = place.rrnn(*words)
        left = [path for path in full.rglob("*") if path.is_file()]
    assert run.returncode == 1
    assert "No space left" in one_sentence(run)
    assert all(path.stat().st_size == 0 for path in left)


@pytest.mark.slow
def test_read_only_folders_are_refused_before_the_work(place):
    with mounted(place.out, "size=64k,ro"):
        commands = [
            ("plan", "problem.json", "--out", "out"),
            ("generate", "minimum_velocity", "--robot", "planar3", "--out", "out"),
            ("spheres", "arm.urdf", "--out", "out/spheres.json"),
            ("reproduce", "fig3", "--out", "out"),
            ("compare", "circle", "--out", "out"),
        ]
        for words in commands:
            run = place.rrnn(*words, "--json")
            assert run.returncode == 2, words
            assert "Read-only file system" in one_sentence(run)
            assert "message" in json.dumps(json.loads(run.stdout))


@pytest.mark.slow
@pytest.mark.parametrize("options", ["size=4k", "size=64k,ro"], ids=["full", "ro"])
def test_a_cache_that_cannot_be_written_costs_time_only(tmp_path, options):
    with mounted(tmp_path / "cache", options) as cache:
        place = furnished(tmp_path / "place", cache)
        run = place.rrnn("plan", "problem.json", "--json")
    assert run.returncode == 0, run.stderr
    assert json.loads(run.stdout)["status"] == "solved"
    assert "RRNN_CACHE_DIR" in one_sentence(run)
    assert list((place.path / "tmp").glob("rrnn_opt-*")) == []


@pytest.mark.slow
def test_a_limit_on_the_size_of_files(tmp_path, warm_cache):
    place = furnished(tmp_path / "place", warm_cache)
    assert place.rrnn("plan", "problem.json").returncode == 0  # compiled now
    limited = (
        "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (9000, 9000));"
        "from rrnn_opt.cli.start import main; raise SystemExit(main())"
    )
    (place.path / "limited.py").write_text(limited)
    run = place.run("limited", "plan", "problem.json", "--out", "out", "--json")
    assert run.returncode == 1
    assert json.loads(run.stdout)["status"] == "solved"
    assert "File too large" in one_sentence(run)
    assert place.litter() == []


@pytest.mark.slow
def test_an_old_table_does_not_stand_beside_a_new_answer(place):
    assert place.rrnn("plan", "problem.json", "--out", "out").returncode == 0
    assert (place.out / "trajectory.csv").exists()
    blocked = PROBLEM["obstacles"][0] | {"position": [1.0, 0.5, 0.0], "radius": 2.0}
    problem = PROBLEM | {"obstacles": [blocked]}
    (place.path / "problem.json").write_text(json.dumps(problem))
    assert place.rrnn("plan", "problem.json", "--out", "out").returncode == 1
    assert json.loads((place.out / "plan.json").read_text())["status"] == "infeasible"
    assert not (place.out / "trajectory.csv").exists()


@pytest.mark.slow
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="needs /dev/full")
def test_a_package_on_a_full_disk(place):
    words = ("generate", "minimum_velocity", "--robot", "planar3", "--out", "out")
    with mounted(place.out, "size=32k") as full:
        run = place.rrnn(*words)
        left = list(full.iterdir())
    assert run.returncode == 1
    assert "No space left" in one_sentence(run)
    assert left == []
