"""Rows of a benchmark, with the machine and the versions they were measured on."""

from __future__ import annotations

import datetime
import json
import os
import platform
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.study.environment import commit
from rrnn_opt.study.identity import versions

RESULTS = Path(__file__).parent / "results"
PACKAGES = ("rrnn_opt", "casadi", "numpy", "pin", "osqp", "daqp", "qpsolvers", "ompl")


@dataclass(frozen=True)
class Row:
    """One measured number.

    Attributes:
        name: what was measured.
        value: the number.
        unit: "s", "1", ...
        ratio: this over the row it is compared with, where there is one.
    """

    name: str
    value: float
    unit: str
    ratio: float | None = None


def surroundings() -> dict[str, Any]:
    """Machine, versions, commit and date."""
    from rrnn_opt.emit import find_compiler

    return {
        "cpu": _cpu(),
        "cores": os.cpu_count(),
        "system": platform.platform(),
        "compiler": find_compiler().version,
        "versions": {"python": platform.python_version()} | versions(PACKAGES),
        "commit": commit() or "unknown",
        "date": datetime.date.today().isoformat(),
    }


@dataclass
class Benchmark:
    """A titled set of rows.

    Attributes:
        name: of the files.
        notes: what a reader must know, in plain sentences.
        rows: measured so far.
        about: machine, versions and commit, as they were before the first row.
    """

    name: str
    notes: str = ""
    rows: list[Row] = field(default_factory=list)
    about: dict[str, Any] = field(default_factory=surroundings)

    def add(self, *rows: Row) -> None:
        """Append rows."""
        self.rows.extend(rows)

    def write(self, folder: Path = RESULTS) -> Path:
        """Write NAME.json and NAME.md; returns the Markdown file."""
        folder.mkdir(parents=True, exist_ok=True)
        head = {"benchmark": self.name, "notes": self.notes, **self.about}
        document = head | {"rows": [asdict(row) for row in self.rows]}
        text = json.dumps(document, indent=1) + "\n"
        (folder / f"{self.name}.json").write_text(text)
        page = folder / f"{self.name}.md"
        page.write_text(self.markdown())
        return page

    def markdown(self) -> str:
        """The rows as a table under the machine they were measured on."""
        about = self.about
        known = ", ".join(f"{k} {v}" for k, v in about["versions"].items())
        lines = [
            f"# {self.name}",
            "",
            self.notes,
            "",
            f"{about['cpu']}, {about['cores']} cores; {about['compiler']}; {known};"
            f" commit {about['commit']}, {about['date']}.",
            "",
            "| what | value | ratio |",
            "|---|---:|---:|",
            *(f"| {r.name} | {shown(r)} | {ratio(r)} |" for r in self.rows),
        ]
        return "\n".join(lines) + "\n"


def shown(row: Row) -> str:
    """Three digits, times in a unit that fits."""
    if row.unit != "s" or not np.isfinite(row.value):
        return f"{row.value:.3g}" + ("" if row.unit == "1" else f" {row.unit}")
    for factor, unit in ((1.0, "s"), (1e-3, "ms"), (1e-6, "us"), (1e-9, "ns")):
        if abs(row.value) >= factor or unit == "ns":
            return f"{row.value / factor:.3g} {unit}"
    raise AssertionError


def ratio(row: Row) -> str:
    return "" if row.ratio is None else f"{row.ratio:.3g}"


def seconds_each(call: Callable[[], object], *, calls: int, repeats: int = 15) -> float:
    """Median over repeats of the mean time of one call."""
    call()
    means = []
    for _ in range(repeats):
        begin = time.perf_counter()
        for _ in range(calls):
            call()
        means.append((time.perf_counter() - begin) / calls)
    return float(np.median(means))


def _cpu() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor() or "unknown processor"
    names = (line.split(":", 1)[1].strip() for line in lines if "model name" in line)
    return next(names, platform.machine())
