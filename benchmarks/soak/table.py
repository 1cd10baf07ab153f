"""The small table that is kept of a soak, and the drift of its processes."""

from __future__ import annotations

import itertools
import platform
import time
from collections import Counter
from collections.abc import Sequence
from typing import Any

import numpy as np

from rrnn_opt.study import wilson

HEADER = (
    "scenes", "plans", "solved", "95 % interval", "other ends",
    "least gap [mm]", "queries", "floored", "broken",
)  # fmt: skip
FOLLOWED = """\
Every delivered trajectory was followed by conservative advancement on coal's
distances with pinocchio's kinematics; *floored* counts its steps that were
longer than the gap allowed, *queries* is their median a plan.  Broken: collision,
less clearance than certified, a limit exceeded, another start or end."""
NOT_FOLLOWED = "No trajectory was followed: this run tells memory and time alone."


def report(found: list[dict[str, Any]]) -> str:
    """The table of rows of a run, as markdown."""
    kinds = list(dict.fromkeys(row["kind"] for row in found))
    groups = [(kind, [r for r in found if r["kind"] == kind]) for kind in kinds]
    body = [_line(name, mine) for name, mine in [*groups, ("all", found)] if mine]
    commits = ", ".join(dict.fromkeys(row["commit"] for row in found)) or "none"
    date = time.strftime("%Y-%m-%d", time.gmtime())
    spent = [row["all_s"] for row in found] or [0.0]
    words = [
        f"Commit {commits}, {platform.machine()}, Python {platform.python_version()},"
        f" {date}; `python -m benchmarks.soak`.",
        "",
        *_followed(found),
        f"CPU time of a plan, p50 / p95: {_times(spent)} ms.",
        *_drift(found),
    ]
    return "\n".join(["# Soak", "", *words, "", _markdown(HEADER, body)])


def _followed(found: list[dict[str, Any]]) -> list[str]:
    if not any("least_m" in row for row in found):
        return [NOT_FOLLOWED]
    dense = [row for row in found if row.get("dense_m") is not None]
    least = f" (least gap {1e3 * _least(dense, 'dense_m'):.3g} mm)" if dense else ""
    return [f"{FOLLOWED}  {len(dense)} were", f"sampled at 1e-3 rad as well{least}."]


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
        f"{1e3 * _least(walked, 'least_m'):.2g}" if walked else "",
        f"{queries:.0f}" if walked else "",
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
