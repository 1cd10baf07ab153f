"""Every benchmark that a page, the Makefile or a module quotes is there."""

import re
from importlib.util import find_spec
from pathlib import Path

import pytest

from benchmarks.__main__ import NAMES

ROOT = Path(__file__).parents[2]
QUOTED = re.compile(r"-m (benchmarks(?:\.\w+)*)(?: ([a-z]\w*))?")
PLACES = ("*.md", "Makefile", "docs/**/*.md", "benchmarks/**/*.py")


def quoted():
    """Module and first word after it, of each ``python -m benchmarks...``."""
    paths = (path for place in PLACES for path in ROOT.glob(place))
    found = (QUOTED.findall(path.read_text("utf-8")) for path in paths)
    return sorted({pair for pairs in found for pair in pairs})


@pytest.mark.parametrize(("module", "word"), quoted())
def test_a_quoted_command_can_be_run(module, word):
    package = find_spec(module)
    assert package is not None
    if package.submodule_search_locations is not None:
        assert find_spec(f"{module}.__main__") is not None
    if module == "benchmarks" and word:
        assert word in NAMES
        assert find_spec(f"benchmarks.ratios.{word}") is not None


def test_many_are_quoted():
    assert len(quoted()) > 15


def test_every_ratio_has_a_name():
    files = {path.stem for path in (ROOT / "benchmarks" / "ratios").glob("[a-z]*.py")}
    assert files == set(NAMES)
