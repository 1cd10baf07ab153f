"""Rows of Table II: errors of all runs, their means and intervals, the best."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.validation.tables.search import Trial
from rrnn_opt.validation.tables.tracking import ENTRIES

GOALS = (0.0005, 0.0015, 0.005)
"""What we set out to reach at each sigma, m."""


@dataclass(frozen=True, eq=False)
class Result:
    """One row of the table.

    Attributes:
        key: of ``ENTRIES``.
        trials: of the search, best first.
        errors: root mean square of each run, (sigmas, circles, seeds), m.
        limits: share of the runs that kept the arm's limits, by sigma.
        unsettled: share of the periods in which the network did not come to rest.
    """

    key: str
    trials: Sequence[Trial]
    errors: NDArray[np.float64]
    limits: tuple[float, ...]
    unsettled: float

    @property
    def means(self) -> NDArray[np.float64]:
        """Mean over circles and seeds, by sigma, m."""
        return np.asarray(self.errors.mean(axis=(1, 2)))

    def interval(self, sigma: int) -> tuple[float, float]:
        """95 % interval of the mean: a seed's mean over the circles is one sample."""
        sample = self.errors[sigma].mean(axis=0)
        return interval(sample)


def interval(sample: NDArray[np.float64]) -> tuple[float, float]:
    """Student's 95 % interval of a mean; the point itself for one sample."""
    from scipy.stats import t

    mean, n = float(sample.mean()), sample.size
    if n < 2:
        return mean, mean
    half = float(t.ppf(0.975, n - 1) * sample.std(ddof=1) / np.sqrt(n))
    return mean - half, mean + half


def best(found: Sequence[Result], sigma: int) -> tuple[Result, Result, bool]:
    """Our best row, the best rival or paper row, and whether the intervals part.

    Args:
        found: all rows.
        sigma: index.
    """

    def least(ours: bool) -> Result:
        chosen = [r for r in found if (ENTRIES[r.key].kind == "ours") == ours]
        return min(chosen, key=lambda r: float(r.means[sigma]))

    mine, other = least(True), least(False)
    return mine, other, mine.interval(sigma)[1] < other.interval(sigma)[0]
