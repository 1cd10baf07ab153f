from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable

import pytest

from rrnn_opt.cli.main import main

Run = Callable[..., subprocess.CompletedProcess]


@pytest.fixture
def rrnn(tmp_path, monkeypatch, capfd) -> Run:
    """Run the command line in this process, in an empty folder."""

    def call(*words: str) -> subprocess.CompletedProcess:
        capfd.readouterr()
        with monkeypatch.context() as patch:
            patch.chdir(tmp_path)
            code = main(words)
        return subprocess.CompletedProcess(words, code, *capfd.readouterr())

    return call


@pytest.fixture
def program(tmp_path) -> Run:
    """Run the command line in a process of its own, in an empty folder."""

    def call(*words: str, **env: str) -> subprocess.CompletedProcess:
        return subprocess.run(
            [sys.executable, "-m", "rrnn_opt.cli.main", *words],
            cwd=tmp_path,
            env=os.environ | env,
            capture_output=True,
            text=True,
            timeout=120,
            check=False,
        )

    return call


@pytest.fixture
def problem(tmp_path) -> Callable[..., str]:
    """Write a small problem of the planar arm; fields can be replaced."""

    def write(**fields: object) -> str:
        document = {
            "robot": "planar3",
            "start": [0.0, 0.5, 0.5],
            "goal": {"joints": [1.0, 0.2, -0.4]},
            "obstacles": [
                {"name": "far", "type": "sphere", "radius": 0.1, "position": [-2, 0, 0]}
            ],
        } | fields
        (tmp_path / "problem.json").write_text(json.dumps(document))
        return "problem.json"

    return write
