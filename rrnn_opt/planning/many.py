"""Many plans at once, on all cores."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import Any

from rrnn_opt.errors import ProblemError
from rrnn_opt.planning.planner import plan
from rrnn_opt.planning.problem import Problem
from rrnn_opt.planning.result import PlanResult


def plan_many(
    problems: Sequence[Problem],
    *,
    seeds: Sequence[int] | None = None,
    jobs: int | None = None,
    **options: Any,
) -> Iterator[PlanResult]:
    """Plan each problem as ``plan`` does; results come in the problems' order.

    Results do not depend on the number of jobs.  Worker processes are started
    afresh and find the compiled planner in the cache; a program that calls
    this needs the usual ``if __name__ == "__main__":``.

    Args:
        problems: any number of problems.
        seeds: one a problem; 0, 1, 2, ... by default.
        jobs: worker processes; as many as there are cores by default.  With
            one job everything runs in this process.
        **options: of ``plan``: planner, settings, time_limit, max_explorations.

    Yields:
        One result a problem, as soon as it and all before it are there.

    Raises:
        ProblemError: the number of seeds or jobs does not fit.
        CompilerError: there is no C compiler.
    """
    chosen = list(range(len(problems))) if seeds is None else list(seeds)
    if len(chosen) != len(problems):
        message = f"{len(chosen)} seeds for {len(problems)} problems"
        raise ProblemError("seeds", message)
    count = (os.cpu_count() or 1) if jobs is None else jobs
    if count < 1:
        raise ProblemError("jobs", f"must be at least 1, got {count}")
    return _planned(problems, chosen, min(count, max(len(problems), 1)), options)


def _planned(
    problems: Sequence[Problem], seeds: list[int], jobs: int, options: dict[str, Any]
) -> Iterator[PlanResult]:
    work = list(zip(problems, seeds, [options] * len(seeds), strict=True))
    if jobs == 1:
        yield from map(_one, work)
        return
    share = max(1, min(16, len(work) // (4 * jobs)))
    with ProcessPoolExecutor(jobs, mp_context=get_context("spawn")) as pool:
        yield from pool.map(_one, work, chunksize=share)


def _one(job: tuple[Problem, int, dict[str, Any]]) -> PlanResult:
    problem, seed, options = job
    return plan(problem, seed=seed, **options)
