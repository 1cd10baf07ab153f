"""No module imports itself by way of others, not even from inside a function."""

import ast
import graphlib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


def modules(folder, package):
    """Path of each module below a folder, by its dotted name; links are followed."""
    found = {}
    for place in (folder, *(p for p in folder.iterdir() if p.is_symlink())):
        for path in place.rglob("*.py"):
            parts = path.relative_to(folder).with_suffix("").parts
            found[".".join((package, *parts)).removesuffix(".__init__")] = path
    return found


def statements(node):
    """Import statements below a node, but for those that only a type checker reads."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.Import | ast.ImportFrom):
            yield child
        elif isinstance(child, ast.If) and "TYPE_CHECKING" in ast.unparse(child.test):
            for other in child.orelse:
                yield from statements(other)
        else:
            yield from statements(child)


def imported(source, known):
    """Names among the known that a source imports; a submodule rather than its room."""
    for statement in statements(ast.parse(source)):
        if isinstance(statement, ast.Import):
            yield from (a.name for a in statement.names if a.name in known)
            continue
        assert statement.level == 0, "imports are absolute"
        for alias in statement.names:
            inner = f"{statement.module}.{alias.name}"
            yield inner if inner in known else statement.module or ""


def circle(sources):
    """Modules that import one another in a circle; none when there is no circle."""
    graph = {
        name: (set(imported(source, sources)) & sources.keys()) - {name}
        for name, source in sources.items()
    }
    try:
        graphlib.TopologicalSorter(graph).prepare()
    except graphlib.CycleError as error:
        return error.args[1]
    return []


@pytest.mark.parametrize("package", ["rrnn_opt", "benchmarks", "tests", "examples"])
def test_there_is_no_circle(package):
    found = modules(ROOT / package, package)
    assert len(found) > 5
    assert circle({n: p.read_text("utf-8") for n, p in found.items()}) == []


def test_the_rooms_beside_the_package_are_looked_at():
    found = modules(ROOT / "rrnn_opt", "rrnn_opt")
    assert "rrnn_opt.formulations.slide" in found
    assert "rrnn_opt.validation.claims" in found
    assert len(found) > 550


LAZY = "def f():\n    from p import a\n"
TYPES = "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from p.a import x\n"


@pytest.mark.parametrize(
    ("back", "found"),
    [("import p.a", True), (LAZY, True), (TYPES, False), ("import q.a", False)],
)
def test_a_circle_is_seen(back, found):
    sources = {"p": "", "p.a": "from p.b import g", "p.b": back}
    assert bool(circle(sources)) == found
