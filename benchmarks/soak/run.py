"""Plan for hours, and follow every delivered motion with foreign distances.

    python -m benchmarks.soak [--plans N] [--hours H] [--jobs J] [--out DIR]
    python -m benchmarks.soak --plan-only --time-limit 0.5   # memory and drift alone

Plan n is of scene kind n modulo their number, with seed n: shipped scenarios,
MotionBenchMaker problems, and random clutter around several arms.  No delivered
trajectory may touch anything when it is followed by conservative advancement
(``benchmarks.follow``), leave a limit, or begin or end elsewhere; every
``DENSE``-th is sampled at 1e-3 rad as well.  Each plan is one line in DIR; a
run that is stopped goes on where it ended, with any number of processes.  The
table is DIR/soak.md (``--table`` only writes it).
"""

from __future__ import annotations

import argparse
import contextlib
import multiprocessing
import resource
import subprocess
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from benchmarks.follow import ends_error, follow, sampled
from benchmarks.soak.scenes import makers
from benchmarks.soak.table import report
from rrnn_opt.planning import plan
from rrnn_opt.report import write_text
from rrnn_opt.study import Lines, read_lines

RESULTS = Path(__file__).parents[2] / "runs" / "soak"
PLANS, DENSE, TIME_LIMIT = 100_000, 300, 20.0
LIMITS = 1e-9
"""Excess over a limit that is rounding: m, rad, or a share of the limit."""


@dataclass(frozen=True)
class Task:
    """What a run does.

    Attributes:
        out: folder of the rows.
        plans: how many.
        time_limit: of each search, s.
        follow: follow what is delivered.
    """

    out: Path
    plans: int
    time_limit: float = TIME_LIMIT
    follow: bool = True


def main(argv: Sequence[str] | None = None) -> int:
    """Run, and write the table; 1 when anything delivered was not as promised."""
    parser = argparse.ArgumentParser("python -m benchmarks.soak", description=__doc__)
    parser.add_argument("--plans", type=int, default=PLANS)
    parser.add_argument("--hours", type=float, default=8.0)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--out", type=Path, default=RESULTS)
    parser.add_argument("--time-limit", type=float, default=TIME_LIMIT, metavar="S")
    parser.add_argument("--plan-only", action="store_true", help="follow nothing")
    parser.add_argument("--table", action="store_true", help="only write the table")
    args = parser.parse_args(argv)
    args.out.mkdir(parents=True, exist_ok=True)
    if not args.table:
        makers(args.out)  # spheres are fitted once
        task = Task(args.out, args.plans, args.time_limit, not args.plan_only)
        _spread(task, args.jobs, time.monotonic() + 3600 * args.hours)
    found = rows(args.out)
    write_text(args.out / "soak.md", report(found))
    print(report(found))
    return 1 if any(row["broken"] for row in found) else 0


def _spread(task: Task, jobs: int, until: float) -> None:
    done = {row["n"] for row in rows(task.out)}
    context = multiprocessing.get_context("spawn")
    work = [(task, job, jobs, until, done) for job in range(jobs)]
    workers = [context.Process(target=_work, args=args) for args in work[1:]]
    for worker in workers:
        worker.start()
    with contextlib.suppress(KeyboardInterrupt):
        _work(*work[0])
    for worker in workers:
        worker.join()


def _work(task: Task, job: int, jobs: int, until: float, done: set[int]) -> None:
    """Every ``jobs``-th plan that is not done yet, one line each."""
    kinds, commit = makers(task.out), _commit()
    lines = Lines(task.out / f"rows.{job}.jsonl")
    for n in range(job, task.plans, jobs):
        if time.monotonic() > until:
            return
        if n not in done:
            row = judged(n, kinds, time_limit=task.time_limit, followed=task.follow)
            row |= {"commit": commit, "job": job, "memory_mb": _memory_mb()}
            lines.append(row)


def _memory_mb() -> float:
    """Resident memory of this process, MB (Linux)."""
    pages = int(Path("/proc/self/statm").read_text("utf-8").split()[1])
    return pages * resource.getpagesize() / 1e6


def judged(
    n: int,
    kinds: dict[str, Any],
    *,
    time_limit: float = TIME_LIMIT,
    followed: bool = True,
) -> dict[str, Any]:
    """Plan n, and what following it finds."""
    name = list(kinds)[n % len(kinds)]
    problem = kinds[name](n // len(kinds))
    begin = time.process_time()
    document = plan(problem, seed=n, time_limit=time_limit).to_dict()
    row = {
        "n": n,
        "kind": name,
        "status": document["status"],
        "explorations": document["stats"]["explorations"],
        "plan_s": document["stats"]["plan_time_s"],
        "all_s": time.process_time() - begin,
        "broken": [],
    }
    if document["trajectory"] and followed:
        row |= _followed(document, dense=n % DENSE == DENSE - 1)
    return row


def _followed(document: dict[str, Any], *, dense: bool) -> dict[str, Any]:
    """What a delivered trajectory really does, and which promises that breaks."""
    walked, (begin, end) = follow(document), ends_error(document)
    fine = sampled(document) if dense else None
    promised = document["certificate"]["clearance_lower_bound"] or 0.0
    least = walked.least if fine is None else min(walked.least, fine)
    broken = {
        "collision": least <= 0.0,
        "clearance": least < promised - 1e-9,
        "limits": walked.outside > LIMITS,
        "start": begin > 0.0,
        "goal": end > 1.0 + 1e-6,
    }
    return {
        "least_m": walked.least,
        "dense_m": fine,
        "queries": walked.queries,
        "floored": walked.floored,
        "outside": walked.outside,
        "broken": [key for key, value in broken.items() if value]
        if document["status"] == "solved"
        else [],
    }


def rows(out: Path) -> list[dict[str, Any]]:
    """What was finished; a line that was cut off by a kill does not count."""
    found: dict[int, dict[str, Any]] = {}
    for path in sorted(out.glob("rows.*.jsonl")):
        for row in filter(None, read_lines(path)):
            found.setdefault(row["n"], row)
    return [found[n] for n in sorted(found)]


def _commit() -> str:
    words = ["git", "rev-parse", "--short", "HEAD"]
    here = Path(__file__).parent
    done = subprocess.run(words, capture_output=True, text=True, check=False, cwd=here)
    return done.stdout.strip() or "unknown"
