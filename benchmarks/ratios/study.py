"""What the study engine costs: overhead, two workers against one, memory.

Overhead: CPU time of everything but the cases themselves, a case, and as a share of
cases of 50 ms.  Throughput: 1200 cases of the same arithmetic, about 50 ms each, on
one worker process and on two.  Memory: what the peak grows by while 100 thousand
rows of about 300 bytes are measured and kept here, and again while they are taken
up.  Other work on the machine makes the throughput a lower bound.
"""

from __future__ import annotations

import resource
import tempfile
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.record import Benchmark, Row
from rrnn_opt.study import Case, Processes, Results

CASE_S = 0.05


@dataclass(frozen=True)
class Arithmetic:
    """Cases of plain Python arithmetic.

    Attributes:
        count: cases.
        turns: of a loop in each.
    """

    count: int
    turns: int
    name: str = "arithmetic"

    def __iter__(self) -> Iterator[Case]:
        return (Case(f"{self.turns}/{k}", {"k": k}) for k in range(self.count))

    def measure(self, case: Case, rng: np.random.Generator) -> Mapping[str, Any]:
        total = 0.0
        for k in range(self.turns):
            total += k * 0.5
        return {"total": total, "draws": rng.random(4).tolist()}


def turns() -> int:
    """Turns of the loop that take 50 ms of CPU time here."""
    began = time.process_time()
    Arithmetic(1, 1_000_000).measure(Case("x"), np.random.default_rng(0))
    return int(1_000_000 * CASE_S / (time.process_time() - began))


def finished(study: Arithmetic, folder: Path, jobs: int | None) -> float:
    """Wall time of a whole study, s; here when jobs is None."""
    workers = None if jobs is None else Processes(jobs)
    began = time.perf_counter()
    with Results(folder) as results:
        count = sum(1 for _ in results.run(study, workers=workers))
    assert count in (0, study.count)
    return time.perf_counter() - began


def run(benchmark: Benchmark) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        began = time.process_time()
        finished(Arithmetic(2000, 1), folder / "empty", None)
        cost = (time.process_time() - began) / 2000
        benchmark.add(
            Row("engine, a case, CPU", cost, "s"),
            Row("engine, share of a case of 50 ms", cost / CASE_S, "1"),
        )
        work = Arithmetic(1200, turns())
        one = finished(work, folder / "one", 1)
        two = finished(work, folder / "two", 2)
        benchmark.add(
            Row("1200 cases, one worker", one, "s"),
            Row("1200 cases, two workers", two, "s", ratio=one / two),
        )
        before, many = peak_mb(), Arithmetic(100_000, 1)
        spent = finished(many, folder / "many", None)
        grown = peak_mb() - before
        again = finished(many, folder / "many", None)
        benchmark.add(
            Row("100 thousand rows, kept", spent, "s"),
            Row("100 thousand rows, growth of the peak", grown, "MB"),
            Row("100 thousand rows, taken up", again, "s"),
            Row("taken up, further growth", peak_mb() - before - grown, "MB"),
        )


def peak_mb() -> float:
    """Largest memory of this process so far, MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1e3
