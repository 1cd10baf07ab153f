"""The documentation site builds without a warning, and shows every room."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
ROOMS = sorted(p.stem for p in (ROOT / "docs" / "api").glob("*.md"))


@pytest.mark.slow
def test_site(tmp_path):
    pytest.importorskip("furo")
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "-b", "html", "docs"]
    done = subprocess.run(
        [*command, str(tmp_path)], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    for room in ROOMS:
        assert (tmp_path / "api" / f"{room}.html").exists()
    assert "closed_loop" in (tmp_path / "api" / "formulations.html").read_text()


def test_every_room_has_its_page():
    package = ROOT / "rrnn_opt"
    inner = {"arguments", "cli", "demo", "validation", "__pycache__"}
    rooms = {p.name for p in package.iterdir() if p.is_dir()} - inner
    assert rooms <= set(ROOMS)


def rooms():
    """Folders and single modules of the package, by name."""
    every = (ROOT / "rrnn_opt").iterdir()
    return {
        path.stem
        for path in every
        if (path.is_dir() or path.suffix == ".py") and not path.stem.startswith("__")
    }


def named_rooms(text):
    """Names in the first column of the table of rooms."""
    table = text.split("## Rooms")[1].split("\n## ")[0]
    rows = re.findall(r"^\| (`.*?) \|", table, re.MULTILINE)
    return {name.strip("/") for row in rows for name in re.findall(r"`(.+?)`", row)}


def lost_paths(text):
    """Paths in backticks that lead nowhere."""
    package = ROOT / "rrnn_opt"
    for path in re.findall(r"`([\w./-]+/[\w./-]*)`", text):
        wild = path.replace("NAME", "*")
        if not any(any(place.glob(wild.rstrip("/"))) for place in (ROOT, package)):
            yield path


def test_the_plan_of_the_house_names_every_room_and_no_other():
    text = (ROOT / "docs" / "architecture.md").read_text("utf-8")
    assert named_rooms(text) == rooms()
    assert named_rooms(text.replace("| `motion` |", "| `moton` |")) != rooms()


def test_paths_in_the_plan_of_the_house_exist():
    """Those inside a room's row may start at that room."""
    text = (ROOT / "docs" / "architecture.md").read_text("utf-8")
    rows = re.findall(r"^\| `(\w+)/?`.*", text, re.MULTILINE)
    lost = set(lost_paths(text))
    for room in rows:
        lost -= {p for p in lost if any((ROOT / "rrnn_opt" / room).rglob(p.strip("/")))}
    assert lost == set()
    assert list(lost_paths("`check/plans/solid/distance.py`")) != []
