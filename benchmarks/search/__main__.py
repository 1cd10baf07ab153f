"""Search time of the planner, family by family, beside VAMP's figures.

    python -m benchmarks.search [--starts 1000] [--seeds 5] [--plans 20]

Each time is the least thread CPU time of five runs of the same search (the
machine is shared), inverse kinematics of tip goals included, set-up of the
problem excluded.  VAMP's figures are those of its own timers (version 0.6.4,
RRT-Connect, joint goals, edges checked every 1/32 rad and not certified),
measured before on a machine of the same kind; this command does not run it.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator

import numpy as np

import rrnn_opt as rr
from benchmarks.record import surroundings
from benchmarks.search.cases import cases
from benchmarks.search.run import Found, searched
from rrnn_opt.planning import Problem
from rrnn_opt.validation.ending import ended

VAMP = {
    "small": (0.043, 0.558),
    "tall": (0.042, 0.147),
    "box": (0.094, 0.239),
    "table_pick": (0.043, 0.079),
    "under_pick": (0.066, 0.140),
}
"""p50 and p95 of its search over all 100 problems of a family, ms."""


def _row(family: str, goal: str, found: list[Found]) -> str:
    solved = [f for f in found if f.status == "solved"]
    times = np.array([f.ms for f in solved])
    p50, p95 = np.percentile(times, [50, 95])
    none = sum(f.status == "no_goal_posture" for f in found)
    peer = VAMP.get(family) if goal == "joints" else None
    beside = (
        f"{peer[0]:.3f} / {peer[1]:.3f} | {p50 / peer[0]:.1f} / {p95 / peer[1]:.1f}"
        if peer
        else " | "
    )
    each = 1e3 * times.sum() / sum(f.steps for f in solved)
    cells = (
        family,
        goal,
        f"{len(solved)}/{len(found)}" + (f" ({none} without posture)" if none else ""),
        f"{p50:.3f} / {p95:.3f}",
        beside,
        f"{np.mean([f.explorations for f in solved]):.2f}",
        f"{np.median([f.steps for f in solved]):.0f}",
        f"{each:.2f}",
    )
    return "| " + " | ".join(cells) + " |"


def searches(starts: int, seeds: int) -> Iterator[str]:
    """The table of searches, line by line."""
    yield (
        "| family | goal | solved | search p50 / p95 [ms] | VAMP [ms] | ratio |"
        " explorations, mean | steps, p50 | step [us] |"
    )
    yield "|---|---|---|---:|---:|---:|---:|---:|---:|"
    for family, goal, problems in cases(starts, seeds):
        found = [searched(Problem.from_dict(d), seed) for d, seed in problems]
        yield _row(family, goal, found)


def plans(count: int) -> Iterator[str]:
    """CPU time of whole ``rr.plan``, and shares of its parts, line by line."""
    yield (
        "| family | proved | whole `rr.plan`, CPU p50 / p95 [ms] |"
        " search | refine | retime | certificate |"
    )
    yield "|---|---|---:|---:|---:|---:|---:|"
    for family, goal, problems in cases(count, 1):
        if goal != "joints" and family not in ("plane", "window"):
            continue
        whole, parts, solved = [], [], 0
        rr.plan(Problem.from_dict(problems[0][0]))  # imports and compiled code
        for data, seed in problems[:count]:
            problem, begin = Problem.from_dict(data), time.process_time()
            result = rr.plan(problem, seed=seed)
            whole.append(1e3 * (time.process_time() - begin))
            stats, proof = result.to_dict()["stats"], result.certificate or {}
            names = ("plan_time_s", "refine_time_s", "retime_time_s")
            parts.append(
                [*(stats.get(n, 0.0) for n in names), proof.get("time_s", 0.0)]
            )
            solved += result.status == "solved"
        p50, p95 = np.percentile(whole, [50, 95])
        shares = np.sum(parts, axis=0) / np.sum(parts)
        shown = " | ".join(f"{share:.0%}" for share in shares)
        yield f"| {family} | {solved}/{len(whole)} | {p50:.1f} / {p95:.1f} | {shown} |"


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.search")
    parser.add_argument("--starts", type=int, default=1000)
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--plans", type=int, default=20)
    args = parser.parse_args()
    about = surroundings()
    print(f"{about['cpu']}; {about['compiler']}; commit {about['commit']}\n")
    for lines in (searches(args.starts, args.seeds), plans(args.plans)):
        for line in lines:
            print(line, flush=True)
        print()
    return 0


if __name__ == "__main__":
    sys.exit(ended(main))
