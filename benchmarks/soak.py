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
import itertools
import multiprocessing
import platform
import resource
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.follow import ends_error, follow, sampled
from benchmarks.soak_scenes import makers
from rrnn_opt.planning import plan
from rrnn_opt.report import write_text
from rrnn_opt.study import Lines, read_lines, wilson

RESULTS = Path(__file__).parents[1] / "runs" / "soak"
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
    parser = argparse.ArgumentParser(description=__doc__)
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
            row = {**judged(n, kinds, task), "commit": commit, "job": job}
            lines.append({**row, "memory_mb": _memory_mb()})


def _memory_mb() -> float:
    """Resident memory of this process, MB (Linux)."""
    pages = int(Path("/proc/self/statm").read_text("utf-8").split()[1])
    return pages * resource.getpagesize() / 1e6


def judged(n: int, kinds: dict[str, Any], task: Task) -> dict[str, Any]:
    """Plan n, and what following it finds."""
    name = list(kinds)[n % len(kinds)]
    problem = kinds[name](n // len(kinds))
    begin = time.process_time()
    document = plan(problem, seed=n, time_limit=task.time_limit).to_dict()
    row = {
        "n": n,
        "kind": name,
        "status": document["status"],
        "explorations": document["stats"]["explorations"],
        "plan_s": document["stats"]["plan_time_s"],
        "all_s": time.process_time() - begin,
        "broken": [],
    }
    if document["trajectory"] and task.follow:
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


def report(found: list[dict[str, Any]]) -> str:
    """The small table that is kept."""
    kinds = list(dict.fromkeys(row["kind"] for row in found))
    groups = [(kind, [r for r in found if r["kind"] == kind]) for kind in kinds]
    body = [_line(name, mine) for name, mine in [*groups, ("all", found)] if mine]
    header: tuple[str, ...] = (
        "scenes",
        "plans",
        "solved",
        "95 % interval",
        "other ends",
    )
    header += ("least gap [mm]", "queries", "floored", "broken")
    dense = [row for row in found if row.get("dense_m") is not None]
    commits = ", ".join(dict.fromkeys(row["commit"] for row in found)) or "none"
    date = time.strftime("%Y-%m-%d", time.gmtime())
    spent = [row["all_s"] for row in found] or [0.0]
    words = [
        f"Commit {commits}, {platform.machine()}, Python {platform.python_version()},"
        f" {date}; `python -m benchmarks.soak`.",
        "",
        "Every delivered trajectory was followed by conservative advancement on coal's",
        "distances with pinocchio's kinematics; *floored* counts its steps that were",
        "longer than the gap allowed, *queries* is their median a plan.  Broken:"
        " collision,",
        "less clearance than certified, a limit exceeded, another start or end."
        f"  {len(dense)} were",
        "sampled at 1e-3 rad as well"
        + (f" (least gap {1e3 * _least(dense, 'dense_m'):.3g} mm)." if dense else "."),
        f"CPU time of a plan, p50 / p95: {_times(spent)} ms.",
        *_drift(found),
    ]
    return "\n".join(["# Soak", "", *words, "", _markdown(header, body)])


def _drift(found: list[dict[str, Any]]) -> list[str]:
    """Memory and time of each process, its first quarter beside its last."""
    told = ["", "Drift, first quarter of a process's plans to its last:", ""]
    runs = dict.fromkeys((row["commit"], row["job"]) for row in found if "job" in row)
    for run in runs:
        mine = [row for row in found if (row["commit"], row.get("job")) == run]
        part = max(1, len(mine) // 4)
        ends = (mine[:part], mine[-part:])
        memory = [np.median([row["memory_mb"] for row in rows]) for rows in ends]
        cpu = [np.median([1e3 * row["all_s"] for row in rows]) for rows in ends]
        told.append(
            f"- {run[0]}, process {run[1]}, {len(mine)} plans: {memory[0]:.0f} to"
            f" {memory[1]:.0f} MB, CPU p50 {cpu[0]:.1f} to {cpu[1]:.1f} ms."
        )
    return told if len(told) > 3 else []


def _line(name: str, mine: list[dict[str, Any]]) -> tuple[str, ...]:
    solved = sum(row["status"] == "solved" for row in mine)
    low, high = wilson(solved, len(mine))
    others = Counter(row["status"] for row in mine if row["status"] != "solved")
    walked = [row for row in mine if "least_m" in row]
    broken = Counter(itertools.chain.from_iterable(row["broken"] for row in mine))
    queries = np.median([row["queries"] for row in walked]) if walked else 0
    return (
        name,
        str(len(mine)),
        str(solved),
        f"{low:.4f} to {high:.4f}",
        ", ".join(f"{v} {k}" for k, v in sorted(others.items())) or "none",
        f"{1e3 * _least(walked, 'least_m'):.2g}",
        f"{queries:.0f}",
        str(sum(row["floored"] for row in walked)),
        ", ".join(f"{v} {k}" for k, v in sorted(broken.items())) or "0",
    )


def _least(found: list[dict[str, Any]], key: str) -> float:
    return min((row[key] for row in found), default=float("nan"))


def _times(seconds: list[float]) -> str:
    p50, p95 = np.percentile(1e3 * np.array(seconds), [50, 95])
    return f"{p50:.1f} / {p95:.1f}"


def _markdown(header: Sequence[str], body: Sequence[Sequence[str]]) -> str:
    lines = [header, ["---"] * len(header), *body]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def _commit() -> str:
    words = ["git", "rev-parse", "--short", "HEAD"]
    here = Path(__file__).parent
    done = subprocess.run(words, capture_output=True, text=True, check=False, cwd=here)
    return done.stdout.strip() or "unknown"


if __name__ == "__main__":
    sys.exit(main())
