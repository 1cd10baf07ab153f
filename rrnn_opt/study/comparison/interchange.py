"""Problem sets from outside: a user's file or folder, a test set of qpbenchmark."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.errors import RrnnError
from rrnn_opt.files import from_python, read_bytes, shown_path
from rrnn_opt.solving import Instance
from rrnn_opt.study.comparison.catalogue import GROUPS
from rrnn_opt.study.comparison.folder import KEYS, read_folder
from rrnn_opt.study.comparison.problem_set import ProblemSet, settled_truth


def is_own(path: str) -> bool:
    """Whether a word names a user's own sets: a file, or a folder that is there.

    Args:
        path: as given on the command line; names of our studies are none.
    """
    return path.endswith((".py", ".parquet")) or (
        path not in (*GROUPS, *GROUPS["all"]) and Path(path).is_dir()
    )


def own_sets(path: str) -> dict[str, ProblemSet]:
    """Sets of a Python file with ``cases()``, a folder, or a Parquet test set.

    ``cases()`` gives ``ProblemSet``s, or pairs of a name and a list of
    ``qpsolvers.Problem``; a list is taken for a sequence where all have one shape.

    Args:
        path: a ``.py`` file, a ``.parquet`` file in qpbenchmark's form, or a folder
            of ``.npz`` files as ``qpsolvers.Problem.save`` writes them, which are
            taken in the order of their names for one set.

    Raises:
        RrnnError: the file cannot be read or holds nothing of the kind.
    """
    if Path(path).is_dir():
        sets = [_made(path, read_folder(path))]
    else:
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
    given = from_python(path, "cases")
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
    _, pq = _arrow()
    read_bytes(path)
    try:
        rows = pq.read_table(path).to_pylist()
    except Exception as error:  # Arrow raises what it likes
        reason = shown_path(str(error).split("\n")[0])
        raise RrnnError(f"{path}: is no Parquet test set ({reason})") from error
    if not rows or not {*KEYS} <= set(rows[0]):
        raise RrnnError(f"{path}: a test set has the columns {', '.join(KEYS)}")
    return [_made(path, [(f"{path}, row {k}", row) for k, row in enumerate(rows)])]


def _made(path: str, rows: Sequence[tuple[str, Mapping[str, Any]]]) -> ProblemSet:
    """A set of arrays row by row, named as the file or folder is."""
    from qpsolvers import Problem

    name = Path(path).resolve().stem
    return named_set(name, [Problem(**_programme(row, at)) for at, row in rows])


def _programme(row: Mapping[str, Any], where: str) -> dict[str, Any]:
    """Arrays of one row, each of the shape that q gives it.

    Raises:
        RrnnError: P or q is missing, rows go without their right sides, a
            length does not fit, or a number is NaN (or infinite, but in h, lb
            and ub).
    """
    parts = {key: _column(row[key], key, where) for key in KEYS}
    q = parts["q"]
    if q is None or not len(q) or parts["P"] is None:
        raise RrnnError(f"{where}: needs P and q")
    n = len(q)
    wide = {"P": n, "G": _length(parts["h"]), "A": _length(parts["b"])}
    for key, rows in wide.items():
        found = parts[key]
        if (found is None) != (rows == 0) or (
            found is not None and len(found) != rows * n
        ):
            raise RrnnError(f"{where}: {key} must hold {rows} rows of {n} numbers")
        parts[key] = None if found is None else found.reshape(rows, n)
    for key in ("lb", "ub"):
        if parts[key] is not None and len(parts[key]) != n:
            raise RrnnError(f"{where}: {key} must hold {n} numbers")
    return parts


def _length(values: Any) -> int:
    return 0 if values is None else len(values)


def _column(value: Any, key: str, where: str) -> Any:
    if value is None:
        return None
    try:
        array = np.array(value, dtype=np.float64)
    except (TypeError, ValueError):
        array = np.array(math.nan)
    bounds = key in ("h", "lb", "ub")
    if (
        array.ndim != 1
        or np.any(np.isnan(array))
        or not (bounds or np.all(np.isfinite(array)))
    ):
        raise RrnnError(f"{where}: {key} must be a list of finite numbers")
    return array if len(array) else None


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
