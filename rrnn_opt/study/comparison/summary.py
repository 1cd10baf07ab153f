"""The rows of ``rrnn compare --json``: one a set, solver and mode."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from rrnn_opt.study.cases import Row
from rrnn_opt.study.comparison.problem_set import INFEASIBLE
from rrnn_opt.study.comparison.statistics import (
    SHIFT_US,
    percentiles,
    shifted_geometric_mean,
    spread,
)
from rrnn_opt.study.wilson import wilson

TOLERANCE = 1e-6
"""Residual within which a problem counts as solved."""


def summaries(rows: Iterable[Row]) -> list[dict[str, Any]]:
    """A summary of each row of the study; a row that failed says why.

    Args:
        rows: of ``Comparison``.
    """
    return [_failed(row) if row.error else summary(row.metrics) for row in rows]


def _failed(row: Row) -> dict[str, Any]:
    stream, solver, mode = row.key.rsplit("/", 2)
    nothing: dict[str, Any] = dict.fromkeys(("time_us", "primal", "dual", "gap"))
    empty = {"n": 0, "solved": 0, "wilson": [0.0, 1.0], **nothing}
    where = {"stream": stream, "solver": solver, "mode": mode}
    return {**where, **empty, "error": row.error}


def summary(metrics: Any) -> dict[str, Any]:
    """One solver in one mode on one set.

    ``n`` counts the problems that are not infeasible; times are of all passes over
    them, solved or not.  ``infeasible`` says what was told and handed out on the
    others: "claims" counts answers that the solver called solved.

    Args:
        metrics: of a row of ``Comparison``.
    """
    there = np.array([t != INFEASIBLE for t in metrics["truth"]])
    solved = there & solves(metrics)
    n = int(there.sum())
    times = np.array(metrics["times_us"])
    return {
        "stream": metrics["stream"],
        "solver": metrics["solver"],
        "mode": metrics["mode"],
        "n": n,
        "solved": int(solved.sum()),
        "wilson": list(wilson(int(solved.sum()), n)),
        "solved_relative": _count_within(metrics["relative"], there),
        "claims_wrongly": int(sum(_claimed(metrics) & there & ~solved)),
        "time_us": percentiles(times[:, there]) if n else None,
        "mean_us": _mean(times, there) if n else None,
        "shift_us": SHIFT_US,
        "spread": spread(times[:, there]) if n else None,
        "inner_us": _median(metrics["inner_us"], there),
        "first_us": metrics["first_us"],
        "passes": len(times),
        "iterations": _median(metrics["iterations"], there),
        **{k: _worst(metrics[k], solved) for k in ("primal", "dual", "gap")},
        "infeasible": _infeasible(metrics, ~there, times),
        "message": metrics["message"],
    }


def solves(metrics: Any) -> Any:
    """Of each problem, whether our judgement is SOLVED, (n,) bool."""
    return np.array([word == "solved" for word in metrics["status"]])


def _claimed(metrics: Any) -> Any:
    return np.array([claim is True for claim in metrics["claims"]])


def _infeasible(metrics: Any, where: Any, times: Any) -> dict[str, Any] | None:
    """What was said and handed out where there is no solution."""
    if not where.any():
        return None
    handed = Counter(
        h for h, here in zip(metrics["handed"], where, strict=True) if here
    )
    return {
        "n": int(where.sum()),
        "claims": int(sum(_claimed(metrics) & where)),
        "handed": dict(sorted(handed.items())),
        "time_us": percentiles(times[:, where]),
    }


def _mean(times: Any, where: Any) -> float:
    return shifted_geometric_mean(np.median(times[:, where], axis=0), SHIFT_US)


def _count_within(values: Sequence[float | None], where: Any) -> int:
    pairs = zip(values, where, strict=True)
    return sum(1 for v, here in pairs if here and v is not None and v <= TOLERANCE)


def _median(values: Sequence[float | None], where: Any) -> float | None:
    kept = [v for v, here in zip(values, where, strict=True) if here and v is not None]
    return float(np.median(kept)) if kept else None


def _worst(values: Sequence[float | None], where: Any) -> float | None:
    kept = [v for v, here in zip(values, where, strict=True) if here and v is not None]
    return max(kept, default=None)
