"""Problem sets from outside: a user's Python file, a test set of qpbenchmark."""

from __future__ import annotations

import runpy
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.errors import RrnnError
from rrnn_opt.solving import Instance
from rrnn_opt.study.comparison.problem_set import ProblemSet, settled_truth

KEYS = ("P", "q", "G", "h", "A", "b", "lb", "ub")
"""Columns of a qpbenchmark test set, matrices row by row; and "name"."""


def own_sets(path: str) -> dict[str, ProblemSet]:
    """Sets of a Python file that defines ``cases()``, or of a Parquet test set.

    ``cases()`` gives ``ProblemSet``s, or pairs of a name and a list of
    ``qpsolvers.Problem``; a list is taken for a sequence where all have one shape.

    Args:
        path: a ``.py`` file, or a ``.parquet`` file in qpbenchmark's form.

    Raises:
        RrnnError: the file cannot be read or holds nothing of the kind.
    """
    sets = _read_test_set(path) if path.endswith(".parquet") else _run_file(path)
    found = {problems.name: problems for problems in sets}
    if not found or len(found) != len(sets):
        raise RrnnError(f"{path}: needs at least one set, each of a name of its own")
    return found


def named_set(name: str, problems: Sequence[Any]) -> ProblemSet:
    """A set of a list of ``qpsolvers.Problem``, its truth found out here.

    Args:
        name: of the set.
        problems: at least one.

    Raises:
        RrnnError: one is no ``qpsolvers.Problem``.
    """
    from qpsolvers import Problem

    if not all(isinstance(problem, Problem) for problem in problems):
        raise RrnnError(f"{name}: every problem must be a qpsolvers.Problem")
    instances = tuple(Instance(_dense(problem)) for problem in problems)
    shapes = {tuple(np.shape(getattr(p, key)) for key in KEYS) for p in problems}
    return ProblemSet(
        name,
        instances,
        settled_truth(instances),
        len(shapes) == 1 and len(problems) > 1,
        f"{len(problems)} problems of the user",
    )


def write_test_set(problems: ProblemSet, path: Path) -> Path:
    """Write a set in the form that qpbenchmark's ``ParquetTestSet`` reads.

    Args:
        problems: the set.
        path: of the Parquet file.

    Raises:
        RrnnError: pyarrow is not installed.
    """
    pa, pq = _arrow()
    columns: dict[str, list[Any]] = {key: [] for key in (*KEYS, "name")}
    for k, instance in enumerate(problems.instances):
        for key in KEYS:
            value = getattr(instance.problem, key)
            columns[key].append(None if value is None else _flat(value))
        columns["name"].append(f"{problems.name}/{k}")
    pq.write_table(pa.table(columns), path)
    return path


def _run_file(path: str) -> list[ProblemSet]:
    try:
        given = list(runpy.run_path(path)["cases"]())
    except KeyError:
        raise RrnnError(f"{path} defines no function cases()") from None
    except OSError as error:
        raise RrnnError(f"{path}: cannot be read ({error.strerror})") from error
    sets = []
    for case in given:
        if isinstance(case, ProblemSet):
            sets.append(case)
        elif isinstance(case, tuple) and len(case) == 2:
            sets.append(named_set(str(case[0]), list(case[1])))
        else:
            raise RrnnError(
                f"{path}: cases() gives pairs (name, [qpsolvers.Problem, ...])"
            )
    return sets


def _read_test_set(path: str) -> list[ProblemSet]:
    from qpsolvers import Problem

    _, pq = _arrow()
    try:
        rows = pq.read_table(path).to_pylist()
    except Exception as error:
        raise RrnnError(f"{path}: is no Parquet test set ({error})") from error
    if not rows or not {*KEYS} <= set(rows[0]):
        raise RrnnError(f"{path}: a test set has the columns {', '.join(KEYS)}")
    made = []
    for row in rows:
        n = len(row["q"])
        parts = {key: _shaped(row[key], key, n) for key in KEYS}
        made.append(Problem(**parts))
    return [named_set(Path(path).stem, made)]


def _shaped(value: list[float] | None, key: str, n: int) -> Any:
    if value is None:
        return None
    array = np.array(value, dtype=np.float64)
    return array.reshape(-1, n) if key in ("P", "G", "A") else array


def _flat(value: Any) -> Any:
    dense = value.toarray() if hasattr(value, "toarray") else np.asarray(value)
    return dense.ravel()


def _dense(problem: Any) -> Any:
    from qpsolvers import Problem

    return Problem(*problem.unpack_as_dense())


def _arrow() -> tuple[Any, Any]:
    try:
        import pyarrow as pa
        import pyarrow.parquet as pq
    except ImportError as error:
        raise RrnnError(
            "Parquet test sets need the extra: pip install 'rrnn_opt[study]'"
        ) from error
    return pa, pq
