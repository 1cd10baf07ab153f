"""Times of all solvers on the same problems, for profiles and advice."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from rrnn_opt.study.cases import Row
from rrnn_opt.study.comparison.problem_set import INFEASIBLE
from rrnn_opt.study.comparison.statistics import (
    Array,
    data_profile,
    performance_profile,
)
from rrnn_opt.study.comparison.summary import solves

RATIOS = np.geomspace(1.0, 1000.0, 200)
BUDGETS_US = np.geomspace(1.0, 1e6, 240)


@dataclass(frozen=True, eq=False)
class TimeTable:
    """Median times of who ran on every set that is looked at.

    Attributes:
        names: "solver, mode" of each line.
        times: (lines, problems), us; infinite where it did not solve.
        worst: (lines,), largest relative residual among the solved; NaN for none.
    """

    names: tuple[str, ...]
    times: Array
    worst: Array

    def profiles(self) -> dict[str, Any]:
        """Both profiles as plain data for a picture."""
        return {
            "names": list(self.names),
            "ratios": RATIOS.tolist(),
            "performance": performance_profile(self.times, RATIOS).tolist(),
            "budgets_us": BUDGETS_US.tolist(),
            "data": data_profile(self.times, BUDGETS_US).tolist(),
            "problems": int(self.times.shape[1]),
        }


def time_table(rows: Iterable[Row], sets: Sequence[str]) -> TimeTable:
    """Median times on the problems of some sets that have a solution.

    Args:
        rows: of ``Comparison``.
        sets: their names; who did not run on all of them is left out, who died or
            ran out of time did not solve.
    """
    kept = [row for row in rows if row.key.rsplit("/", 2)[0] in sets]
    sizes = {row.metrics["stream"]: _there(row) for row in kept if not row.error}
    lines: dict[str, dict[str, Row]] = {}
    for row in kept:
        stream, solver, mode = row.key.rsplit("/", 2)
        lines.setdefault(f"{solver}, {mode}", {})[stream] = row
    names = [name for name, found in lines.items() if len(found) == len(sets)]
    order = [name for name in sets if name in sizes]
    times = [
        np.concatenate([_times(lines[n][s], sizes[s]) for s in order]) for n in names
    ]
    worst = [_worst([lines[n][s] for s in order]) for n in names]
    shape = (len(names), sum(int(sizes[s].sum()) for s in order))
    return TimeTable(tuple(names), np.array(times).reshape(shape), np.array(worst))


def _there(row: Row) -> Any:
    return np.array([truth != INFEASIBLE for truth in row.metrics["truth"]])


def _times(row: Row, there: Any) -> Array:
    if row.error:
        return np.full(int(there.sum()), np.inf)
    median = np.median(np.array(row.metrics["times_us"]), axis=0)
    return np.asarray(np.where(solves(row.metrics), median, np.inf)[there])


def _worst(rows: Sequence[Row]) -> float:
    found = [
        value
        for row in rows
        if not row.error
        for value, word in zip(
            row.metrics["relative"], row.metrics["status"], strict=True
        )
        if word == "solved" and value is not None
    ]
    return max(found, default=float("nan"))
