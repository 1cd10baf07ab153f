"""The wheel, made from the sdist, in an environment of its own."""

import email
import json
import os
import re
import runpy
import subprocess
import sys
import sysconfig
import tarfile
import tomllib
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
    assert [n for n in names if n.endswith((".pyc", ".so")) or "cache__" in n] == []
    (built,) = folder.glob("*.whl")
    return built


def test_every_requirement_says_the_lowest_version_that_is_tried(capsys):
    """What .ci/pythons installs beside the wheel."""
    runpy.run_path(str(ROOT / ".ci" / "lowest.py"), run_name="__main__")
    lines = capsys.readouterr().out.splitlines()
    assert all(re.fullmatch(r"[\w.-]+==\d[\w.]*", line) for line in lines)
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    wanted = {r.replace(">=", "==") for r in declared["dependencies"]}
    assert wanted <= set(lines)


@pytest.mark.slow
def test_the_wheel_holds_all_modules_and_data_and_nothing_else(wheel):
    """Byte by byte what the tree holds, so the sdist it is made from is whole."""
    tracked = run("git", "ls-files", "rrnn_opt", "formulations", "validation", cwd=ROOT)
    files = [f for f in tracked.stdout.split() if not (ROOT / f).is_symlink()]
    inside = {f if f.startswith("rrnn_opt/") else f"rrnn_opt/{f}": f for f in files}
    with zipfile.ZipFile(wheel) as archive:
        names = {n for n in archive.namelist() if ".dist-info/" not in n}
        assert names == set(inside)
        for name, file in inside.items():
            assert archive.read(name) == (ROOT / file).read_bytes(), name
    assert "rrnn_opt/py.typed" in names


@pytest.mark.slow
def test_the_wheel_says_what_an_index_asks_for(wheel):
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    with zipfile.ZipFile(wheel) as archive:
        (place,) = (n for n in archive.namelist() if n.endswith("/METADATA"))
        said = email.message_from_bytes(archive.read(place))
        others = {n.rsplit("/", 1)[-1] for n in archive.namelist() if "licenses/" in n}
    assert said["Name"] == declared["name"]
    assert said["Version"] == declared["version"]
    assert said["Requires-Python"] == declared["requires-python"]
    assert said["License-Expression"] == declared["license"]
    assert others == set(declared["license-files"])
    assert said["Description-Content-Type"] == "text/markdown"
    text = said.get_payload(decode=True).decode()
    assert text.strip() == (ROOT / "README.md").read_text().strip()
    plain = [r for r in said.get_all("Requires-Dist") if "extra ==" not in r]
    assert set(plain) == set(declared["dependencies"])
    assert set(said.get_all("Provides-Extra")) == set(declared["optional-dependencies"])


@pytest.mark.slow
def test_the_wheel_runs_the_demo_from_another_folder(wheel, tmp_path):
    """With the packages of this environment (.ci/pythons installs them anew)."""
    home = tmp_path / "a new place"
    home.mkdir()
    venv.create(home / "env")
    python = home / "env" / "bin" / "python"
    pip = [sys.executable, "-m", "pip", "--python", python, "install", "--quiet"]
    run(*pip, "--no-deps", wheel, cwd=home)
    (packages,) = (home / "env").glob("lib/python*/site-packages")
    (packages / "neighbours.pth").write_text(sysconfig.get_path("purelib") + "\n")
    cache = str(home / "cache")
    rrnn = [python, "-m", "rrnn_opt.cli.main"]
    shown = run(*rrnn, "demo", "--json", cwd=home, RRNN_CACHE_DIR=cache)
    report = json.loads(shown.stdout)
    assert report["passed"], report["checks"]
    assert (home / "runs" / "demo" / "plan.html").is_file()
    run(*rrnn, "check", "runs/demo/plan.json", cwd=home, RRNN_CACHE_DIR=cache)
