"""One search for all: the gains of every row, on noise that the table never sees."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from rrnn_opt.errors import RrnnError
from rrnn_opt.validation.tables.tracking import CIRCLES, SIGMAS, Entry, Runner

FIRST_SEED = 1_000_000
"""Of the noise of the search; the table counts from 0."""


@dataclass(frozen=True)
class Trial:
    """Gains, and the score that they reached.

    Attributes:
        gains: by name.
        score: geometric mean over the sigmas of the mean error, m; infinite
            where the run diverged.
    """

    gains: Mapping[str, float]
    score: float


def search(entry: Entry, *, points: int = 40, seeds: int = 2) -> list[Trial]:
    """Gains of one row, best first.

    Half of the points are log-uniform in the ranges; the other half are the
    best point so far, each gain multiplied by exp of a normal number of
    deviation 0.3, cut at the ranges.  Rows without gains have one trial.

    Args:
        entry: the row.
        points: how many gains are tried.
        seeds: noise seeds of each circle and sigma.
    """
    if not entry.ranges:
        return [Trial({}, score(entry, {}, seeds))]
    low, high = (np.log([r[k] for r in entry.ranges.values()]) for k in (0, 1))
    rng = np.random.default_rng(FIRST_SEED)
    found: list[Trial] = []
    best = (low + high) / 2.0
    for k in range(points):
        if k < points // 2:
            x = rng.uniform(low, high)
        else:
            x = np.clip(best + 0.3 * rng.standard_normal(low.size), low, high)
        gains = dict(zip(entry.ranges, np.exp(x).round(6).tolist(), strict=True))
        found.append(Trial(gains, score(entry, gains, seeds)))
        if found[-1].score <= min(t.score for t in found):
            best = x
    return sorted(found, key=lambda t: t.score)


def score(entry: Entry, gains: Mapping[str, float], seeds: int) -> float:
    """Geometric mean over the sigmas of the mean error over circles and seeds, m."""
    runner, means = Runner(entry, gains), []
    try:
        for sigma in SIGMAS:
            errors = [
                runner.run(circle, sigma, FIRST_SEED + k).rms_error_m
                for circle in CIRCLES
                for k in range(seeds)
            ]
            means.append(np.mean(errors))
    except RrnnError:
        return float("inf")
    return float(np.exp(np.mean(np.log(means))))
