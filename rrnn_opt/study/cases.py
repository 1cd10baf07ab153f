"""Cases, rows, and what a study is: seeded cases in, one row each out."""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from rrnn_opt.arguments import checked
from rrnn_opt.errors import RrnnError

TIMINGS = ("_s", "_ms", "_us", "_ns")
"""Ends of the names of columns that hold times, which no two runs share."""


@checked()
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
        time_s: wall time of the measurement, s; no part of equality.
        lost: its worker died each time; such a row is never kept.
    """

    key: str
    metrics: Mapping[str, Any]
    error: str = ""
    time_s: float = field(default=0.0, compare=False)
    lost: bool = False


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
        """The metric columns of one case; randomness from ``rng`` only.

        Columns that hold times end in "_s", "_ms", "_us" or "_ns".

        Args:
            case: one of the study's.
            rng: the case's own random numbers.
        """
        ...


class Workers(Protocol):
    """Where cases are measured: here, in processes, on a cluster."""

    def rows(self, study: Study, cases: Iterator[Case], seed: int) -> Iterator[Row]:
        """One row a case, as they are finished; cases are taken as needed.

        Args:
            study: whose metric is measured.
            cases: of the study, in any number.
            seed: of the whole study.
        """
        ...


@checked()
def generator(case: Case, *, seed: int = 0) -> np.random.Generator:
    """The case's own random numbers: from its key, not from its place.

    Args:
        case: the case.
        seed: of the whole study.
    """
    digest = hashlib.sha256(f"{seed}\0{case.key}".encode()).digest()
    entropy = int.from_bytes(digest, "big")
    return np.random.default_rng(np.random.SeedSequence(entropy))


def measured(study: Study, case: Case, seed: int) -> Row:
    """Measure one case; an error of the package becomes a row, a bug does not."""
    began = time.perf_counter()
    try:
        metrics, error = study.measure(case, generator(case, seed=seed)), ""
    except RrnnError as failure:
        metrics, error = {}, f"{type(failure).__name__}: {failure}"
    return Row(case.key, plain(metrics), error, time.perf_counter() - began)


def plain(metrics: Mapping[str, Any]) -> dict[str, Any]:
    """Metrics as they come back from a file: numbers, texts, lists and tables.

    Raises:
        TypeError: a value is none of these and no NumPy number or array.
    """
    data: dict[str, Any] = json.loads(json.dumps(dict(metrics), default=_listed))
    return data


def _listed(value: Any) -> Any:
    if isinstance(value, np.generic | np.ndarray):
        return value.tolist()
    raise TypeError(f"a metric of type {type(value).__name__} cannot be kept in a file")


def once(study: Study) -> Iterator[Case]:
    """The cases of a study, each key once; in memory only a digest of each key.

    Raises:
        RrnnError: two cases have the same key.
    """
    seen: set[bytes] = set()
    for case in study:
        digest = hashlib.blake2b(case.key.encode(), digest_size=12).digest()
        if digest in seen:
            raise RrnnError(
                f"study '{study.name}': two cases have the same key '{case.key}'"
            )
        seen.add(digest)
        yield case
