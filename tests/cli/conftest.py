from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

Run = Callable[..., subprocess.CompletedProcess]


@pytest.fixture(scope="session")
def cache(tmp_path_factory) -> Path:
    """One cache of compiled code for all commands of a session."""
    return tmp_path_factory.mktemp("cache")


@pytest.fixture
def rrnn(cache, tmp_path) -> Run:
    """Run the command line in a process of its own, in an empty folder."""

    def call(*words: str, **env: str) -> subprocess.CompletedProcess:
        return subprocess.run(
            [sys.executable, "-m", "rrnn_opt.cli.main", *words],
            cwd=tmp_path,
            env=os.environ | {"RRNN_CACHE_DIR": str(cache)} | env,
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
