"""The sanitizers find what is there, and nothing in ours."""

import shutil
import subprocess
import sys

import pytest

from benchmarks import sanitize
from tests.faults.conftest import HERE

PROGRAM = """
from rrnn_opt.emit import build, load
head = '__attribute__((visibility("default"))) int '
load(build(head + "grow(int x) {{ return x + 2147483647; }}", name="grow")).grow({grow})
body = "far(int n) {{ volatile int a[4] = {{1}}; return a[n]; }}"
load(build(head + body, name="far")).far({far})
"""


@pytest.fixture
def bench(tmp_path, monkeypatch):
    """The sanitizing compiler, in a folder of the test's own."""
    if shutil.which("gcc") is None:
        pytest.skip("needs gcc")
    monkeypatch.setattr(sanitize, "WORK", tmp_path)
    return tmp_path


@pytest.mark.slow
@pytest.mark.parametrize(("grow", "far"), [(-7, 3), (7, 3), (-7, 4)])
def test_what_is_broken_is_found_and_nothing_else(bench, grow, far):
    reports = bench / "reports"
    reports.mkdir()
    environment = sanitize.environment(reports) | {"PYTHONPATH": str(HERE)}
    words = [sys.executable, "-c", PROGRAM.format(grow=grow, far=far)]
    done = subprocess.run(words, env=environment, check=False, capture_output=True)
    found = bool(list(reports.iterdir())) or b"runtime error" in done.stderr
    assert found == ((grow, far) != (-7, 3)), done.stderr


@pytest.mark.slow
def test_the_planner_is_clean(bench):
    room = "tests/planning/search/test_library.py"
    outcome, findings = sanitize.run(room, 0, slow=False)
    assert outcome["passed"] > 0
    assert outcome["failed"] == 0
    assert findings == []
    page = sanitize.report({room: (outcome, findings)}, "COMMAND")
    assert f"{outcome['passed']} tests passed, 0 findings" in page
