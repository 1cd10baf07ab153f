"""What no source file may do: unpickle, evaluate, or load what runs code."""

from __future__ import annotations

import ast

import pytest

WORKERS = "rrnn_opt.study.processes"
"""It hands objects to the processes that it starts, and no file to anyone."""
EVALUATES = {"eval", "exec", "compile", "__import__"}
UNPICKLES = {"pickle", "shelve", "marshal", "dill", "cloudpickle", "joblib", "yaml"}


def calls(tree):
    """(name, node) of the calls in a file; for a method its last two words."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call):
            yield ast.unparse(node.func), node


@pytest.fixture(scope="module")
def trees(house):
    """Syntax by dotted name of every file; formulations and validation are linked."""
    found = {name: module.tree for name, module in house.modules.items()}
    assert {"rrnn_opt.formulations.slide", "rrnn_opt.validation"} <= set(found)
    return found


def test_nothing_is_unpickled(trees):
    found = []
    for path, tree in trees.items():
        for node in ast.walk(tree):
            names = []
            if isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            elif isinstance(node, ast.ImportFrom):
                names = [node.module or ""]
            if UNPICKLES & {name.split(".")[0] for name in names}:
                found.append(path)
    assert found == [WORKERS]


def test_arrays_are_read_without_objects(trees):
    for path, tree in trees.items():
        for name, node in calls(tree):
            if name in ("np.load", "numpy.load") or name.endswith("read_array"):
                given = {key.arg: ast.unparse(key.value) for key in node.keywords}
                assert given.get("allow_pickle") == "False", path


def test_no_text_is_run(trees):
    for path, tree in trees.items():
        for name, node in calls(tree):
            assert name not in EVALUATES, f"{path}:{node.lineno}"
            given = {key.arg: ast.unparse(key.value) for key in node.keywords}
            assert given.get("shell", "False") == "False", f"{path}:{node.lineno}"
            assert name not in ("os.system", "os.popen"), f"{path}:{node.lineno}"


def test_users_programs_are_run_in_one_place(trees):
    runs = [path for path, tree in trees.items() for name, _ in calls(tree)
            if name.startswith("runpy.")]  # fmt: skip
    assert runs == ["rrnn_opt.files"]
