"""Semidefinite programmes for Clarabel, in a process of its own.

What comes back are floating-point numbers that prove nothing.
"""

from __future__ import annotations

import importlib.util
import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from rrnn_opt.errors import UndecidedError
from rrnn_opt.verification.engines.process import run_apart

Array = NDArray[np.float64]
WORKER = Path(__file__).with_name("conic_worker.py")


@dataclass(frozen=True, eq=False)
class ConicProgram:
    """Maximise t <= 1 subject to A x = b, G_j(x) - t I >= 0, and x_i >= t.

    The first entries of x are the upper triangles of the symmetric matrices
    G_j, column by column; then come ``positive`` numbers, then free ones.

    Attributes:
        matrix: A, (m, n).
        right: b, (m,).
        sizes: of the matrices G_j.
        positive: how many of the numbers that follow must be at least t.
    """

    matrix: Array
    right: Array
    sizes: tuple[int, ...]
    positive: int = 0


def require_clarabel() -> None:
    """Ask for the solver.

    Raises:
        UndecidedError: it is not installed.
    """
    if importlib.util.find_spec("clarabel") is None:
        raise UndecidedError("clarabel is not installed: pip install rrnn_opt[verify]")


def solve(program: ConicProgram, wall_s: float) -> tuple[float, Array] | None:
    """Solve a programme.

    Args:
        program: the programme.
        wall_s: wall limit; the process is killed at its end, s.

    Returns:
        t and x of the best point found; None where there is none in time.
    """
    matrix = sparse.coo_array(program.matrix)
    job = {
        "shape": matrix.shape,
        "row": matrix.row.tolist(),
        "column": matrix.col.tolist(),
        "data": matrix.data.tolist(),
        "right": program.right.tolist(),
        "sizes": program.sizes,
        "positive": program.positive,
    }
    done = run_apart(WORKER, job, wall_s)
    if done is None or done.returncode != 0:
        return None
    answer = json.loads(done.stdout)
    return answer if answer is None else (answer[0], np.array(answer[1]))
