"""Empty folders for commands, and one cache of compiled code for them all."""

from __future__ import annotations

from pathlib import Path

import pytest

from benchmarks.faults.place import HERE, PROBLEM, Place, furnished, whole

__all__ = ["HERE", "PROBLEM", "Place", "furnished", "whole"]


@pytest.fixture(scope="session")
def warm_cache(tmp_path_factory) -> Path:
    """One cache of compiled code for all commands of a session."""
    return tmp_path_factory.mktemp("cache")


@pytest.fixture
def place(tmp_path, warm_cache) -> Place:
    """An empty folder with a problem and an arm in it, and a shared cache."""
    return furnished(tmp_path / "place", warm_cache)
