"""Finished rows of a study in a file, so that a run can be stopped and taken up."""

from __future__ import annotations

import json
import time
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.study import Case, Row, Study, rows


@dataclass(frozen=True)
class Rest:
    """The cases of a study that are not finished; picklable as the study is."""

    study: Study
    finished: frozenset[str]

    @property
    def name(self) -> str:
        """The study's."""
        return self.study.name

    def __iter__(self) -> Iterator[Case]:
        """What is left, in the study's order."""
        return (c for c in self.study if _identity(c) not in self.finished)

    def measure(self, case: Case, rng: np.random.Generator) -> Mapping[str, Any]:
        """The study's own."""
        return self.study.measure(case, rng)


class Ledger:
    """Rows by case, seed and parameters, one JSON object a line.

    A row counts as finished only for the same seed and the same parameters of
    its case; a line that was cut off is ignored.

    Args:
        path: of the file; made where it is missing.
        seed: of the study.
    """

    def __init__(self, path: Path, *, seed: int = 0) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        self._path, self._seed = path, seed
        self._entries = [e for e in _read(path) if e["seed"] == seed]
        self._wanted: set[str] = set()

    def choose(self, study: Study) -> dict[str, str]:
        """Count the rows of a study among those that are asked for below.

        Args:
            study: whose rows.

        Returns:
            What identifies each case in the file, by key.
        """
        cases = {case.key: _identity(case) for case in study}
        self._wanted |= set(cases.values())
        return cases

    def run(self, study: Study, *, jobs: int = 1) -> Iterator[Row]:
        """Run what is left of a study, keeping each row as it is finished.

        Args:
            study: what to run.
            jobs: worker processes.
        """
        cases = self.choose(study)
        finished = frozenset(entry["case"] for entry in self._entries)
        began = time.perf_counter()
        for row in rows(Rest(study, finished), jobs=jobs, seed=self._seed):
            entry = {"case": cases[row.key], "seed": self._seed, **asdict(row)}
            entry["time_s"], began = time.perf_counter() - began, time.perf_counter()
            self._entries.append(entry)
            with self._path.open("a", encoding="utf-8") as file:
                file.write(json.dumps(entry) + "\n")
            yield row

    @property
    def metrics(self) -> list[Mapping[str, Any]]:
        """Of all finished rows of the studies chosen or run."""
        return [e["metrics"] for e in self._chosen if not e["error"]]

    @property
    def errors(self) -> list[str]:
        """Key and error of the rows that failed."""
        return [f"{e['key']}: {e['error']}" for e in self._chosen if e["error"]]

    @property
    def time_s(self) -> float:
        """What they took, s."""
        return float(sum(e["time_s"] for e in self._chosen))

    @property
    def _chosen(self) -> list[dict[str, Any]]:
        return [e for e in self._entries if e["case"] in self._wanted]


def _identity(case: Case) -> str:
    """Key and parameters of a case as one string."""
    return json.dumps([case.key, dict(case.parameters)], sort_keys=True)


def _read(path: Path) -> Iterator[dict[str, Any]]:
    if not path.exists():
        return
    for line in path.read_text("utf-8").splitlines():
        try:
            yield json.loads(line)
        except json.JSONDecodeError:
            continue
