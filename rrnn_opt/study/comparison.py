"""Comparisons of solvers, summed up: one row a solver and mode."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from rrnn_opt.solving import Comparison, Status
from rrnn_opt.study.wilson import wilson

PERCENTILES = {"p50": 50.0, "p95": 95.0, "p999": 99.9, "max": 100.0}


def summarise(stream: str, rows: Sequence[Comparison]) -> list[dict[str, Any]]:
    """The rows of ``rrnn compare --json``.

    Args:
        stream: name of the stream.
        rows: of one ``compare``.

    Returns:
        For each solver and mode, in order of appearance: how many QPs, how many
        solved with Wilson's interval, percentiles of the time in microseconds,
        and the largest primal, dual and gap residual of those solved (None
        when none was).
    """
    order = dict.fromkeys((row.solver, row.mode) for row in rows)
    return [
        _summary(stream, [row for row in rows if (row.solver, row.mode) == key])
        for key in order
    ]


def _summary(stream: str, rows: Sequence[Comparison]) -> dict[str, Any]:
    solved = [row for row in rows if row.status is Status.SOLVED]
    times = 1e6 * np.array([row.time_s for row in rows])
    return {
        "stream": stream,
        "solver": rows[0].solver,
        "mode": rows[0].mode,
        "n": len(rows),
        "solved": len(solved),
        "wilson": list(wilson(len(solved), len(rows))),
        "time_us": {k: float(np.percentile(times, p)) for k, p in PERCENTILES.items()},
        "primal": _worst(solved, lambda row: row.residual.primal),
        "dual": _worst(solved, lambda row: row.residual.dual),
        "gap": _worst(solved, lambda row: row.residual.gap),
        "primal_difference": _worst(solved, lambda row: row.primal),
        "dual_difference": _worst(solved, lambda row: max(row.equality, row.box)),
    }


def _worst(
    rows: Sequence[Comparison], measure: Callable[[Comparison], float]
) -> float | None:
    """The largest value; what could not be measured (NaN) is left out."""
    values = [value for row in rows if not math.isnan(value := measure(row))]
    return max(values, default=None)
