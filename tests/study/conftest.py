import importlib
import sys
from pathlib import Path

import pytest


@pytest.fixture
def studies(monkeypatch):
    """The module of studies, importable by worker processes too."""
    folder = Path(__file__).parent / "importable"
    monkeypatch.syspath_prepend(folder)
    monkeypatch.setenv("PYTHONPATH", str(folder), prepend=":")
    yield importlib.import_module("studies_for_tests")
    sys.modules.pop("studies_for_tests", None)
