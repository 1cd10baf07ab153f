"""Rows of a study, kept in a file so that a run can go on where it stopped."""

from __future__ import annotations

import json
import os
import platform
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib import metadata
from pathlib import Path
from typing import Any

from rrnn_opt.study import Case, Study, rows


@dataclass(frozen=True)
class _Rest:
    """A study without the cases that are done."""

    study: Study
    done: frozenset[str]

    @property
    def name(self) -> str:
        return self.study.name

    def __iter__(self) -> Iterator[Case]:
        return (case for case in self.study if case.key not in self.done)

    def measure(self, case: Case, rng: Any) -> Any:
        return self.study.measure(case, rng)


def collect(study: Study, file: Path, *, jobs: int = 1) -> list[dict[str, Any]]:
    """Metrics of every case, in the study's order.

    Args:
        study: what to run.
        file: JSON lines, one a finished case; what is there is not run again.
        jobs: worker processes.

    Returns:
        Metrics of each case; {"error": ...} where it failed.
    """
    file.parent.mkdir(parents=True, exist_ok=True)
    kept: dict[str, Any] = {}
    if file.exists():
        for line in file.read_text("utf-8").splitlines():
            entry = json.loads(line)
            kept[entry["key"]] = entry["metrics"]
    rest = _Rest(study, frozenset(kept))
    with file.open("a", encoding="utf-8") as out:
        for row in rows(rest, jobs=jobs):
            metrics = dict(row.metrics) or {"error": row.error}
            kept[row.key] = metrics
            out.write(json.dumps({"key": row.key, "metrics": metrics}) + "\n")
            out.flush()
    return [kept[case.key] for case in study]


def surroundings(command: str) -> str:
    """Command, machine and date as lines of Markdown."""
    import rrnn_opt

    version = metadata.version(rrnn_opt.__name__)
    cores = f"{os.cpu_count()} cores, {platform.machine()}, {_processor()}"
    date = datetime.now(UTC).strftime("%Y-%m-%d")
    return (
        f"Made by `{command}`  \n"
        f"on {cores}, {platform.system()}, Python {platform.python_version()},"
        f" rrnn_opt {version}, {date}."
    )


def _processor() -> str:
    """Name of the processor where the system tells it."""
    try:
        text = Path("/proc/cpuinfo").read_text("utf-8")
    except OSError:
        return platform.processor() or "unknown processor"
    names = [line.split(":")[1] for line in text.splitlines() if "model name" in line]
    return names[0].strip() if names else "unknown processor"
