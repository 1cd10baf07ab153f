"""The wheel, made from the sdist, in an environment of its own."""

import json
import os
import subprocess
import sys
import tarfile
import venv
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


def run(*command: str | Path, cwd: Path, **env: str) -> subprocess.CompletedProcess:
    words = [str(word) for word in command]
    clean = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH",)}
    done = subprocess.run(
        words,
        cwd=cwd,
        env=clean | env,
        capture_output=True,
        text=True,
        check=False,
        timeout=1200,
    )
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-4000:]
    return done


@pytest.fixture(scope="module")
def wheel(tmp_path_factory) -> Path:
    """Built as a stranger would: the sdist from the tree, the wheel from it."""
    folder = tmp_path_factory.mktemp("dist")
    run(sys.executable, "-m", "build", "--outdir", folder, ROOT, cwd=folder)
    (sdist,) = folder.glob("*.tar.gz")
    with tarfile.open(sdist) as archive:
        names = [n.split("/", 1)[-1] for n in archive.getnames()]
    wanted = ("rrnn_opt/formulations/slide.py", "LICENSE", "NOTICE", "Makefile")
    assert set(wanted) <= set(names)
    (built,) = folder.glob("*.whl")
    return built


@pytest.mark.slow
def test_the_wheel_holds_all_modules_and_data(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
    tracked = run("git", "ls-files", "rrnn_opt", "formulations", "validation", cwd=ROOT)
    files = [f for f in tracked.stdout.split() if not (ROOT / f).is_symlink()]
    inside = [f if f.startswith("rrnn_opt/") else f"rrnn_opt/{f}" for f in files]
    assert [f for f in inside if f not in names] == []
    top = {name.split("/")[0] for name in names}
    assert {t for t in top if not t.endswith(".dist-info")} == {"rrnn_opt"}


@pytest.mark.slow
def test_the_wheel_runs_the_demo_from_another_folder(wheel, tmp_path):
    home = tmp_path / "a new place"
    home.mkdir()
    venv.create(home / "env", with_pip=True)
    python = home / "env" / "bin" / "python"
    run(python, "-m", "pip", "install", "--quiet", wheel, cwd=home)
    cache = str(home / "cache")
    rrnn = [python, "-m", "rrnn_opt.cli.main"]
    shown = run(*rrnn, "demo", "--json", cwd=home, RRNN_CACHE_DIR=cache)
    report = json.loads(shown.stdout)
    assert report["passed"], report["checks"]
    assert (home / "runs" / "demo" / "plan.html").is_file()
    run(*rrnn, "check", "runs/demo/plan.json", cwd=home, RRNN_CACHE_DIR=cache)
