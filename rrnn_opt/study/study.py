"""Studies: seeded cases in, rows out; the same on one worker or many."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass, field
from multiprocessing import get_context
from typing import Any, Protocol

import numpy as np

from rrnn_opt.errors import RrnnError


@dataclass(frozen=True)
class Case:
    """One case of a study.

    Attributes:
        key: its identity, unique in the study, e.g. "pa10/sigma=0.05/17"; the
            random numbers of the case follow from it and from nothing else.
        parameters: what the metric needs to know.
    """

    key: str
    parameters: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class Row:
    """What was measured in one case.

    Attributes:
        key: the case's.
        metrics: column -> value; empty when the case failed.
        error: kind and message of the package's own error, or "".
    """

    key: str
    metrics: Mapping[str, Any]
    error: str = ""


class Study(Protocol):
    """Cases and a metric; must be picklable to run on several workers."""

    @property
    def name(self) -> str:
        """Name for files and tables."""
        ...

    def __iter__(self) -> Iterator[Case]:
        """The cases, in the order of the rows."""
        ...

    def measure(self, case: Case, rng: np.random.Generator) -> Mapping[str, Any]:
        """The metric columns of one case; randomness from ``rng`` only."""
        ...


def generator(case: Case, *, seed: int = 0) -> np.random.Generator:
    """The case's own random numbers: from its key, not from its place.

    Args:
        case: the case.
        seed: of the whole study.
    """
    digest = hashlib.sha256(f"{seed}\0{case.key}".encode()).digest()
    entropy = int.from_bytes(digest, "big")
    return np.random.default_rng(np.random.SeedSequence(entropy))


def rows(study: Study, *, jobs: int = 1, seed: int = 0) -> Iterator[Row]:
    """Rows as they are finished; leaving early keeps what was yielded.

    Args:
        study: what to run.
        jobs: worker processes; 1 runs here.
        seed: of the whole study.

    Yields:
        One row a case; in the study's order when ``jobs`` is 1.

    Raises:
        ValueError: two cases have the same key.
    """
    cases = list(study)
    if len({case.key for case in cases}) != len(cases):
        raise ValueError(f"study '{study.name}': two cases have the same key")
    if jobs == 1:
        yield from (_row(study, case, seed) for case in cases)
        return
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        futures = [pool.submit(_row, study, case, seed) for case in cases]
        try:
            for future in as_completed(futures):
                yield future.result()
        finally:
            pool.shutdown(cancel_futures=True)


def run(
    study: Study,
    *,
    jobs: int = 1,
    seed: int = 0,
    progress: Callable[[int, int], None] | None = None,
) -> list[Row]:
    """All rows in the order of the cases, whatever the number of workers.

    Args:
        study: what to run.
        jobs: worker processes.
        seed: of the whole study.
        progress: told (finished, all) after each case.

    Returns:
        One row a case.
    """
    order = [case.key for case in study]
    finished: dict[str, Row] = {}
    for row in rows(study, jobs=jobs, seed=seed):
        finished[row.key] = row
        if progress is not None:
            progress(len(finished), len(order))
    return [finished[key] for key in order]


def _row(study: Study, case: Case, seed: int) -> Row:
    """Measure one case; an error of the package becomes a row, a bug does not."""
    try:
        return Row(case.key, dict(study.measure(case, generator(case, seed=seed))))
    except RrnnError as error:
        return Row(case.key, {}, f"{type(error).__name__}: {error}")
