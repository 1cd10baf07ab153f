"""The documentation site builds without a warning, and shows every room."""

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
    inner = {"cli", "demo", "validation", "__pycache__"}
    rooms = {p.name for p in package.iterdir() if p.is_dir()} - inner
    assert rooms <= set(ROOMS)
