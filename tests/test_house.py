"""The house stays small: files of 250 lines, functions of 30, but for those named."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
FILE_LINES, BODY_LINES = 250, 30
ROOMS = ("rrnn_opt", "formulations", "validation", "benchmarks", "tests", "examples")

LONG_FUNCTIONS = {
    "rrnn_opt/robot/serial.py: robot_to_dict": "a document, field by field",
    "rrnn_opt/embedding/render.py: common_words": "a table of template words",
    "rrnn_opt/cli/spheres.py: add_arguments": "a table of options",
    "validation/claims/c24.py: case": "one statement, read beside the paper",
}
"""Functions whose body is longer, and why parting them would not make them clearer."""
LONG_FILES: dict[str, str] = {}
"""Files that are longer, and why."""
OWN_FOLDERS = {
    "faults": "what breaks from outside, whatever the room",
    "fuzz": "inputs that were bad once, whatever the room",
    "study/importable": "a study as a user's module has it",
}
"""Folders of tests that mirror no room, and why."""


def sources(*endings: str) -> list[Path]:
    """Files of the rooms; links are not followed, so that each is there once."""
    places = [ROOT / room for room in ROOMS]
    inner = [place / name for place in places[:1] for name in ROOMS[1:]]
    found = [f for place in places for e in endings for f in place.rglob(f"*{e}")]
    return [f for f in found if not set(inner) & set(f.parents)]


def body_lines(function: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    """Lines from the first statement to the last, the docstring left out."""
    first = function.body[0]
    words = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant)
    rest = function.body[1:] if words else function.body
    return (rest[-1].end_lineno or 0) - rest[0].lineno + 1 if rest else 0


def long_functions(path: Path, name: str) -> set[str]:
    """``file: function`` of each whose body is over the limit."""
    return {
        f"{name}: {node.name}"
        for node in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
        and body_lines(node) > BODY_LINES
    }


def test_functions_are_short_but_for_those_named():
    files = sources(".py")
    assert len(files) > 900
    found = {
        entry
        for path in files
        for entry in long_functions(path, path.relative_to(ROOT).as_posix())
    }
    assert found == set(LONG_FUNCTIONS), "mend the function, or the list"


def test_files_are_short_but_for_those_named():
    found = {
        path.relative_to(ROOT).as_posix()
        for path in sources(".py", ".c", ".h")
        if len(path.read_text("utf-8").splitlines()) > FILE_LINES
    }
    assert found == set(LONG_FILES), "mend the file, or the list"


def test_folders_of_tests_mirror_the_rooms():
    rooms = {
        place.relative_to(root).as_posix()
        for root in (ROOT, ROOT / "rrnn_opt")
        for place in (*root.glob("*"), *root.glob("*/**"))
        if place.is_dir()
    }
    tests = ROOT / "tests"
    inner = {path.parent.relative_to(tests).as_posix() for path in tests.rglob("*.py")}
    assert inner - rooms - {"."} == set(OWN_FOLDERS)


def test_every_test_that_a_script_or_a_page_names_is_there():
    named = {
        (path, word)
        for path in (*ROOT.glob(".ci/*"), *ROOT.glob("docs/*.md"), ROOT / "Makefile")
        for word in re.findall(r"\btests/[\w/.]*\w(?![\w*])", path.read_text("utf-8"))
    }
    assert len(named) > 10
    assert [pair for pair in named if not (ROOT / pair[1]).exists()] == []


@pytest.mark.parametrize(("lines", "long"), [(30, False), (31, True)])
def test_a_body_is_counted_without_signature_and_docstring(tmp_path, lines, long):
    text = 'def f(\n    a,\n):\n    """One.\n\n    Two.\n    """\n' + "    a\n" * lines
    path = tmp_path / "f.py"
    path.write_text(text)
    assert long_functions(path, "f.py") == ({"f.py: f"} if long else set())
