"""Every example runs, and so does the README's block of Python."""

import re
import runpy
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


@pytest.mark.parametrize(
    "path", sorted((ROOT / "examples").glob("*.py")), ids=lambda p: p.stem
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


def test_the_proof_of_the_tutorial(capfd):
    (block,) = blocks("docs/tutorials/verify.md")
    exec(compile(block, "verify.md", "exec"), {"__name__": "__main__"})
    assert capfd.readouterr().out.split() == ["PROVED", "exact"]
