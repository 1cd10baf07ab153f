"""Every example runs, and so does the README's block of Python."""

import json
import re
import runpy
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from rrnn_opt.cli.main import main

ROOT = Path(__file__).parents[1]


@pytest.fixture(autouse=True)
def _elsewhere(monkeypatch, tmp_path):
    """In an empty folder; a warning is an error, as in all tests."""
    monkeypatch.chdir(tmp_path)


def blocks(page):
    """The blocks of Python in a page."""
    return re.findall(r"```python\n(.*?)```", (ROOT / page).read_text(), re.S)


EXAMPLES = sorted((ROOT / "examples").glob("*.py"))
QUICK = ("quickstart", "verify_my_claim")


@pytest.mark.parametrize(
    "path",
    [
        pytest.param(path, marks=() if path.stem in QUICK else pytest.mark.slow)
        for path in EXAMPLES
    ],
    ids=lambda path: path.stem,
)
def test_example(path, capfd, monkeypatch):
    monkeypatch.setattr(sys, "argv", [str(path)])
    runpy.run_path(str(path), run_name="__main__")
    assert capfd.readouterr().out.strip()


def test_readme_python(tmp_path):
    """As a reader runs it: in a process of its own."""
    (block,) = blocks("README.md")
    assert len([line for line in block.splitlines() if line.strip()]) <= 12
    command = [sys.executable, "-W", "error", "-c", block]
    done = subprocess.run(
        command, cwd=tmp_path, capture_output=True, text=True, timeout=120, check=False
    )
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "build" / "arm" / "MANIFEST.json").exists()


@pytest.mark.parametrize(
    "arguments",
    [
        ("plan", "window.json"),
        ("verify", "verify_my_claim.py"),
        ("verify", "verify_other_systems.py"),
        ("simulate", "position_feedback", "--robot", "pa10", "--task", "circle.toml"),
    ],
    ids=lambda a: f"{a[0]}_{Path(a[1]).stem}",
)
def test_command_of_an_example_file(arguments, capfd):
    files = {p.name: str(p) for p in (ROOT / "examples").iterdir()}
    assert main([files.get(a, a) for a in arguments]) == 0, capfd.readouterr().err


@pytest.mark.slow
def test_the_loop_around_a_generated_controller(tmp_path):
    """As its first lines say: generated, compiled with every warning, and run."""
    compiler = shutil.which("cc") or pytest.skip("cc is not installed")
    words = ["generate", "closed_loop", "--robot", "panda", "--prefix", "arm"]
    assert main([*words, "--out", "build"]) == 0
    strict = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-Wconversion"]
    sources = ["build/arm/src/arm.c", "build/arm/src/arm_selftest.c"]
    command = [compiler, *strict, "-O2", "-ffp-contract=off", "-Ibuild/arm/include"]
    command += [
        *sources,
        str(ROOT / "examples" / "embed_main.c"),
        "-lm",
        "-o",
        "circle",
    ]
    subprocess.run(command, cwd=tmp_path, check=True, timeout=120)
    done = subprocess.run(
        [tmp_path / "circle"], capture_output=True, text=True, check=False, timeout=60
    )
    assert (done.returncode, done.stdout) == (0, "back within 0.0 mm\n")


@pytest.mark.slow
def test_one_claim_for_each_kind_of_verdict(capfd):
    path = str(ROOT / "examples" / "verify_my_network.py")
    assert main(["verify", path, "--json"]) == 1
    rows = json.loads(capfd.readouterr().out)["claims"]
    assert [row["verdict"] for row in rows] == ["HOLDS_UNDER", "REFUTED", "UNKNOWN"]
    assert rows[0]["mutation"] == "rate 3: REFUTED"
    assert "no bounds" in rows[2]["reason"]


def test_the_proof_of_the_tutorial(capfd):
    (block,) = blocks("docs/tutorials/verify.md")
    exec(compile(block, "verify.md", "exec"), {"__name__": "__main__"})
    assert capfd.readouterr().out.split() == ["PROVED", "exact"]


@pytest.mark.slow
def test_the_problem_file_of_the_tutorial_and_its_csv(tmp_path, capfd):
    page = (ROOT / "docs/tutorials/plan.md").read_text("utf-8")
    (problem,) = re.findall(r"```json\n(.*?)```", page, re.S)
    (tmp_path / "shelf.json").write_text(problem)
    assert main(["plan", "shelf.json", "--out", "runs/window"]) == 0
    (block,) = blocks("docs/tutorials/plan.md")
    exec(compile(block, "plan.md", "exec"), {"__name__": "__main__"})
    assert "7) largest step [rad] 0.0" in capfd.readouterr().out


def test_every_field_of_a_problem_file_is_in_the_tutorial():
    from rrnn_opt.planning.problem import goals, problem
    from rrnn_opt.scene import shapes

    page = (ROOT / "docs/tutorials/plan.md").read_text("utf-8")
    known = {*problem._REQUIRED, *problem._OPTIONAL, *goals._FIELDS} - {"name"}
    named = {name for name in known | {"name"} if f"`{name}`" in page}
    named |= {"joints"} if '{"joints": [..]}' in page else set()
    assert named >= known
    kinds = (shapes.Box, shapes.Cylinder, shapes.Capsule, shapes.Sphere)
    assert [k.kind for k in kinds if f"`{k.kind}`" not in page] == []
