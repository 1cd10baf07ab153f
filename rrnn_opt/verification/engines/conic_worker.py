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
    rows, right, cones = _programme(job, clarabel)
    size = rows.shape[1]
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.max_threads = 1
    solver = clarabel.DefaultSolver(
        sparse.csc_matrix((size, size)),
        np.append(np.zeros(size - 1), -1.0),
        rows,
        right,
        cones,
        settings,
    )
    solution = solver.solve()
    if str(solution.status) not in ("Solved", "AlmostSolved", "InsufficientProgress"):
        return None
    return float(solution.x[-1]), [float(v) for v in solution.x[:-1]]


def _programme(job: dict[str, Any], clarabel: Any) -> tuple[Any, Any, list[Any]]:
    """Rows, right-hand side, cones: equations, X_k - t I >= 0, x - t >= 0, t <= 1."""
    (equations, count), positive = job["shape"], job["positive"]
    place = (job["row"], job["column"])
    rows = [sparse.csc_array((job["data"], place), shape=(equations, count + 1))]
    cones = [clarabel.ZeroConeT(equations)]
    start = 0
    for size in job["sizes"]:
        scale, diagonal = triangle(size)
        where = np.arange(start, start + len(scale))
        block = sparse.lil_array((len(scale), count + 1))
        block[np.arange(len(scale)), where] = -scale
        block[np.flatnonzero(diagonal), count] = 1.0
        rows.append(block.tocsc())
        cones.append(clarabel.PSDTriangleConeT(size))
        start += len(scale)
    last = sparse.lil_array((positive + 1, count + 1))
    for k in range(positive):
        last[k, start + k], last[k, count] = -1.0, 1.0
    last[positive, count] = 1.0
    rows.append(last.tocsc())
    cones.append(clarabel.NonnegativeConeT(positive + 1))
    right = np.concatenate([job["right"], np.zeros(start + positive), [1.0]])
    return sparse.csc_matrix(sparse.vstack(rows)), right, cones


def triangle(size: int) -> tuple[Array, Array]:
    """Scale of each upper-triangular entry, and whether it is on the diagonal."""
    column = np.repeat(np.arange(size), np.arange(1, size + 1))
    row = np.concatenate([np.arange(k + 1) for k in range(size)] or [np.array([])])
    diagonal = column == row
    return np.where(diagonal, 1.0, np.sqrt(2.0)), diagonal


if __name__ == "__main__":
    json.dump(solved(json.load(sys.stdin)), sys.stdout)
