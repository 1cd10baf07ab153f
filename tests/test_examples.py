"""Every example runs, and so does the README's block of Python."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


def run(command, folder):
    return subprocess.run(
        command, cwd=folder, capture_output=True, text=True, timeout=120, check=False
    )


@pytest.mark.parametrize(
    "path", sorted((ROOT / "examples").glob("*.py")), ids=lambda p: p.stem
)
def test_example(path, tmp_path):
    done = run([sys.executable, "-W", "error", str(path)], tmp_path)
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip()


def test_readme_python(tmp_path):
    text = (ROOT / "README.md").read_text()
    (block,) = re.findall(r"```python\n(.*?)```", text, re.S)
    assert len([line for line in block.splitlines() if line.strip()]) <= 12
    done = run([sys.executable, "-W", "error", "-c", block], tmp_path)
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
def test_command_of_an_example_file(arguments, tmp_path):
    files = {p.name: str(p) for p in (ROOT / "examples").iterdir()}
    command = [sys.executable, "-m", "rrnn_opt.cli.main"]
    done = run(command + [files.get(a, a) for a in arguments], tmp_path)
    assert done.returncode == 0, done.stderr


def test_the_proof_of_the_tutorial(tmp_path):
    text = (ROOT / "docs" / "tutorials" / "verify.md").read_text()
    (block,) = re.findall(r"```python\n(.*?)```", text, re.S)
    done = run([sys.executable, "-W", "error", "-c", block], tmp_path)
    assert done.stdout.split() == ["PROVED", "exact"], done.stderr
