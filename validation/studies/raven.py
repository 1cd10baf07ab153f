"""Raven II through an opening of 4 cm: the paper's third experiment, repeated.

    python -m rrnn_opt.validation.studies.raven --starts 1000 --out FILE.md

The scenario ``raven_opening`` holds a closed box with a square opening 6 cm
beyond the remote centre and a target inside that the straight tool cannot
reach: the wrist has to bend.  Starts are drawn uniformly inside the position
limits and kept when nothing touches; the first ones ship with the scenario.
Source: section IV-C of Li, Li and Hannaford 2019, doi 10.1109/TII.2018.2869588,
which reports one successful run and no dimensions.
"""

from __future__ import annotations

import argparse
import platform
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.planning import Problem, RandomRnn, plan
from rrnn_opt.planning.search.request import pack
from rrnn_opt.planning.searches import open_search, runtime_for
from rrnn_opt.report import write_text
from rrnn_opt.scene.library import scenario
from rrnn_opt.study import Case, run, wilson
from rrnn_opt.validation.ending import ended
from rrnn_opt.validation.tables.collect import metrics_of

Array = NDArray[np.float64]
SCENARIO = "raven_opening"
BLOCK = 4096
COMMAND = "python -m rrnn_opt.validation.studies.raven"


@lru_cache(maxsize=4)
def drawn_starts(count: int, seed: int = 0) -> Array:
    """Uniform postures inside the limits that touch nothing, (count, 6).

    A longer list begins with the shorter ones.

    Args:
        count: how many.
        seed: of the draws; 0 gives those that ship first.
    """
    data = scenario(SCENARIO).problem(0)
    problem, settings = Problem.from_dict(data), RandomRnn()
    limits = problem.robot.limits
    rng = np.random.default_rng([seed, 4])
    packed, found = pack(problem, (), (), 0), np.zeros((0, problem.robot.nv))
    with open_search(runtime_for(problem.robot, settings), settings, packed) as search:
        while len(found) < count:
            q = rng.uniform(limits.lower, limits.upper, (BLOCK, problem.robot.nv))
            found = np.concatenate([found, q[search.postures_free(q)]])
    return found[:count]


@dataclass(frozen=True)
class RavenTrials:
    """One case is a plan from one start; its seed is the start's number.

    Attributes:
        starts: how many.
        planner: a name of ``PLANNERS``.
        seed: of the starts.
        name: of the study.
    """

    starts: int = 1000
    planner: str = "random-rnn"
    seed: int = 0
    name: str = "raven_opening"

    def __iter__(self) -> Iterator[Case]:
        """Start by start."""
        for i in range(self.starts):
            yield Case(f"{self.planner}/{self.seed}/{i}", {"start": i})

    def measure(self, case: Case, rng: np.random.Generator) -> Mapping[str, Any]:
        """Status, explorations, proved clearance and time of one plan."""
        index = int(case.parameters["start"])
        start = drawn_starts(self.starts, self.seed)[index].tolist()
        data = {**scenario(SCENARIO).problem(0), "start": start}
        result = plan(Problem.from_dict(data), seed=index, planner=self.planner)
        stats = result.stats
        return {
            "start": index,
            "status": result.status,
            "solved": result.solved,
            "random": stats.random,
            "heuristic": stats.heuristic,
            "total": stats.explorations,
            "clearance_m": result.certificate["clearance_lower_bound"],
            "plan_ms": 1e3 * stats.plan_time_s,
            "all_ms": 1e3 * (stats.time_s - stats.compile_time_s),
        }


def raven_rows(starts: int = 1000, *, jobs: int = 1) -> list[dict[str, Any]]:
    """One row a start: what ``RavenTrials.measure`` tells.

    Args:
        starts: how many.
        jobs: worker processes.

    Raises:
        RrnnError: a start could not be run.
    """
    return metrics_of(list(run(RavenTrials(starts), jobs=jobs)))


def page(rows: Sequence[Mapping[str, Any]], command: str) -> str:
    """The rows' summary as a page."""
    lines = [
        "# Raven II through an opening of 4 cm",
        "",
        f"`{command}`, {platform.machine()}, Python {platform.python_version()}",
        "",
        "![The instrument enters the box](../images/raven.png)",
        "",
        "A closed box of 12 cm with a square opening of 4 cm, 6 cm beyond the remote",
        "centre; the target inside lies where the straight tool does not reach it"
        " through",
        "the opening, so the wrist has to bend.  The shaft (radius 5 mm) is a capsule"
        " covered",
        "by spheres; the remote centre is exact, for the axes of the model meet in it.",
        "Starts are uniform in the position limits and free.  Solved means found *and*"
        " proved.",
        "The paper shows one run on the machine and prints no dimensions: the scene is"
        " ours.",
        "",
        "| what | value |",
        "| --- | --- |",
    ]
    return "\n".join([*lines, *_summary(rows)]) + "\n"


def _summary(rows: Sequence[Mapping[str, Any]]) -> list[str]:
    """Rows of the table: how the starts ended, what they took, how near it came."""
    solved = [row for row in rows if row["solved"]]
    low, high = wilson(len(solved), len(rows))
    others = Counter(row["status"] for row in rows if not row["solved"])
    ends = ", ".join(f"{v} {k}" for k, v in sorted(others.items())) or "none"
    lines = [
        f"| starts | {len(rows)} |",
        f"| solved and proved | {len(solved)} ({low:.4f} to {high:.4f}) |",
        f"| other ends | {ends} |",
    ]
    names = {
        "total": "explorations",
        "random": "of them random",
        "plan_ms": "search [ms]",
        "all_ms": "search, retiming and proof [ms]",
    }
    for key, title in names.items():
        values = [row[key] for row in solved] or [float("nan")]
        p50, p95, most = np.percentile(values, [50, 95, 100])
        lines.append(
            f"| {title}, p50 / p95 / most | {p50:.3g} / {p95:.3g} / {most:.3g} |"
        )
    least = min((row["clearance_m"] for row in solved), default=float("nan"))
    return [*lines, f"| least proved clearance [mm] | {1e3 * least:.4g} |"]


def main(argv: Sequence[str] | None = None) -> int:
    """Run the trials and write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--starts", type=int, default=1000)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--out", type=Path, required=True)
    args = parser.parse_args(argv)
    rows = raven_rows(args.starts, jobs=args.jobs)
    write_text(args.out, page(rows, f"{COMMAND} --starts {args.starts}"))
    return 0 if all(row["solved"] for row in rows) else 1


if __name__ == "__main__":
    sys.exit(ended(main))
