"""Statistics of a comparison: means, profiles, percentiles."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rrnn_opt.errors import RrnnError

Array = NDArray[np.float64]

PERCENTILES = {"p50": 50.0, "p95": 95.0, "p99": 99.0, "p999": 99.9, "max": 100.0}
SHIFT_US = 10.0
"""Shift of the geometric means of times, microseconds."""


def shifted_geometric_mean(values: ArrayLike, shift: float) -> float:
    """exp(mean(log(v + shift))) - shift: large values weigh little, tiny ones too.

    Args:
        values: not negative; at least one.
        shift: positive; in the unit of the values.

    Raises:
        RrnnError: there is no value, or one is negative or no number.
    """
    given = np.asarray(values, dtype=np.float64)
    if given.size == 0 or not (given >= 0.0).all() or shift <= 0.0:
        raise RrnnError("a shifted geometric mean needs values >= 0 and a shift > 0")
    return float(np.exp(np.mean(np.log(given + shift))) - shift)


def performance_profile(times: ArrayLike, ratios: ArrayLike) -> Array:
    """Share of the problems that a solver solves within a factor of the best.

    Args:
        times: (solvers, problems), infinite where one did not solve; problems
            that nobody solved count for all and are solved by none.
        ratios: (k,) factors, at least one.

    Returns:
        (solvers, k), each row rising.

    Source:
        E. Dolan, J. More, Math. Programming 91, 2002, pp. 201-213.
    """
    table = np.asarray(times, dtype=np.float64)
    best = table.min(axis=0)
    solved = np.isfinite(best)
    ratio = np.full(table.shape, np.inf)
    ratio[:, solved] = table[:, solved] / best[solved]
    within = ratio[:, :, None] <= np.asarray(ratios, dtype=np.float64)
    return np.asarray(within.mean(axis=1))


def data_profile(times: ArrayLike, budgets: ArrayLike) -> Array:
    """Share of the problems that a solver solves within a budget of time.

    Args:
        times: (solvers, problems), infinite where one did not solve.
        budgets: (k,), in the unit of the times.

    Returns:
        (solvers, k), each row rising.
    """
    table = np.asarray(times, dtype=np.float64)
    within = table[:, :, None] <= np.asarray(budgets, dtype=np.float64)
    return np.asarray(within.mean(axis=1))


def percentiles(values: ArrayLike) -> dict[str, float]:
    """The ``PERCENTILES`` of values, at least one."""
    given = np.asarray(values, dtype=np.float64)
    return {k: float(np.percentile(given, p)) for k, p in PERCENTILES.items()}


def spread(passes: ArrayLike) -> float:
    """Median over the problems of (q75 - q25) / median over the passes.

    Args:
        passes: (passes, problems).
    """
    table = np.asarray(passes, dtype=np.float64)
    low, mid, high = np.percentile(table, [25, 50, 75], axis=0)
    return float(np.median((high - low) / mid))
