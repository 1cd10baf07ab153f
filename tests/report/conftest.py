from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

import pytest

_SPEC = importlib.util.spec_from_file_location(
    "report_documents", Path(__file__).with_name("documents.py")
)
documents = importlib.util.module_from_spec(_SPEC)
sys.modules["report_documents"] = documents
_SPEC.loader.exec_module(documents)


@pytest.fixture(autouse=True)
def coarse(monkeypatch) -> None:
    """Draw at a third of the resolution: the tests look at shares of pixels."""
    monkeypatch.setattr("rrnn_opt.report.plan.picture.DPI", 36)


@pytest.fixture
def window() -> dict:
    """A PA10 that reaches through a window."""
    return documents.window()


@pytest.fixture
def every_shape() -> dict:
    """A planar arm among one obstacle of each kind."""
    return documents.every_shape()


@pytest.fixture
def pa10() -> dict:
    """Robot block of a PA10-like arm."""
    return documents.pa10()


@pytest.fixture
def planar() -> dict:
    """Robot block of a planar arm with a prismatic joint."""
    return documents.planar()
