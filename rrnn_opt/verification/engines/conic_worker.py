"""Clarabel on one semidefinite programme, as a process of its own.

Run by path, with nothing of this package imported.  Standard input is the
programme of ``conic.py`` as JSON, standard output ``[t, [x, ..]]`` or null.
"""

from __future__ import annotations

import importlib
import json
import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

Array = NDArray[Any]


def solved(job: dict[str, Any]) -> tuple[float, list[float]] | None:
    """The least eigenvalue t and all numbers x; None without a solution."""
    clarabel: Any = importlib.import_module("clarabel")
    (equations, count), positive = job["shape"], job["positive"]
    place = (job["row"], job["column"])
    rows = [sparse.csc_array((job["data"], place), shape=(equations, count + 1))]
    right = [np.array(job["right"])]
    cones = [clarabel.ZeroConeT(equations)]
    start = 0
    for size in job["sizes"]:
        scale, diagonal = triangle(size)
        where = np.arange(start, start + len(scale))
        block = sparse.lil_array((len(scale), count + 1))
        block[np.arange(len(scale)), where] = -scale
        block[np.flatnonzero(diagonal), count] = 1.0
        rows.append(block.tocsc())
        right.append(np.zeros(len(scale)))
        cones.append(clarabel.PSDTriangleConeT(size))
        start += len(scale)
    last = sparse.lil_array((positive + 1, count + 1))
    for k in range(positive):
        last[k, start + k], last[k, count] = -1.0, 1.0
    last[positive, count] = 1.0
    rows.append(last.tocsc())
    right.append(np.append(np.zeros(positive), 1.0))
    cones.append(clarabel.NonnegativeConeT(positive + 1))
    cost = np.append(np.zeros(count), -1.0)
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.max_threads = 1
    zero = sparse.csc_matrix((count + 1, count + 1))
    table = sparse.csc_matrix(sparse.vstack(rows))
    solver = clarabel.DefaultSolver(
        zero, cost, table, np.concatenate(right), cones, settings
    )
    solution = solver.solve()
    if str(solution.status) not in ("Solved", "AlmostSolved", "InsufficientProgress"):
        return None
    return float(solution.x[-1]), [float(v) for v in solution.x[:-1]]


def triangle(size: int) -> tuple[Array, Array]:
    """Scale of each upper-triangular entry, and whether it is on the diagonal."""
    column = np.repeat(np.arange(size), np.arange(1, size + 1))
    row = np.concatenate([np.arange(k + 1) for k in range(size)] or [np.array([])])
    diagonal = column == row
    return np.where(diagonal, 1.0, np.sqrt(2.0)), diagonal


if __name__ == "__main__":
    json.dump(solved(json.load(sys.stdin)), sys.stdout)
