"""Many plans at once, on all cores."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from dataclasses import dataclass, field
from multiprocessing import get_context
from typing import Any

from rrnn_opt.arguments import checked
from rrnn_opt.errors import ProblemError
from rrnn_opt.planning.planner import plan
from rrnn_opt.planning.problem.problem import Problem
from rrnn_opt.planning.result import PlanResult

SHARE = 8
"""Plans handed out at a time, at most."""
AHEAD = 2
"""Shares that a process has, the one it works on included: it never waits."""


@checked()
def plan_many(
    problems: Sequence[Problem],
    *,
    seeds: Sequence[int] | None = None,
    jobs: int | None = None,
    **options: Any,
) -> Iterator[PlanResult]:
    """Plan each problem as ``plan`` does; results come in the problems' order.

    Results do not depend on the number of jobs.  This process is one of them: it
    plans while the others start, which are started afresh, find the compiled
    planner in the cache and take work when they are ready.  A program that calls
    this needs the usual ``if __name__ == "__main__":``.

    Args:
        problems: any number of problems.
        seeds: one a problem; 0, 1, 2, ... by default.
        jobs: processes, this one included; as many as there are cores by default.
        **options: of ``plan``: planner, settings, time_limit, max_explorations.

    Yields:
        One result a problem, as soon as it and all before it are there.

    Raises:
        ProblemError: the number of seeds or jobs does not fit.
        KeyboardInterrupt: a plan was interrupted; the results before it were
            yielded.
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
    work = [Job(*pair, options) for pair in zip(problems, seeds, strict=True)]
    share = max(1, min(SHARE, len(work) // (8 * jobs)))
    shares = [work[i : i + share] for i in range(0, len(work), share)]
    found = map(_plans, shares) if jobs == 1 else _among(shares, jobs - 1)
    for results in found:
        for result in results:
            if result.status == "interrupted":
                raise KeyboardInterrupt
            yield result


@dataclass(frozen=True)
class Job:
    """One plan to make."""

    problem: Problem
    seed: int
    options: dict[str, Any]


def _plans(share: list[Job]) -> list[PlanResult]:
    return [plan(job.problem, seed=job.seed, **job.options) for job in share]


def _among(shares: list[list[Job]], others: int) -> Iterator[list[PlanResult]]:
    """Results of the shares in order, made by other processes and by this one."""
    with ProcessPoolExecutor(others, mp_context=get_context("spawn")) as pool:
        desk = _Desk(pool, deque(enumerate(shares)))
        try:
            for _ in range(AHEAD * others):
                pool.submit(_plans, []).add_done_callback(desk.hand_out)
            for number in range(len(shares)):
                yield desk.results_of(number)
        finally:
            desk.waiting.clear()  # nothing more is handed out


@dataclass
class _Desk:
    """Where processes fetch their next share, the first that nobody has.

    Attributes:
        pool: the other processes.
        waiting: shares that nobody has, with their numbers.
        given: what the others work on, or have done.
        made: what was made here.
    """

    pool: ProcessPoolExecutor
    waiting: deque[tuple[int, list[Job]]]
    given: dict[int, Future[list[PlanResult]]] = field(default_factory=dict)
    made: dict[int, list[PlanResult]] = field(default_factory=dict)

    def hand_out(self, _: object) -> None:
        """Give the next share to a process that has finished one."""
        try:
            number, share = self.waiting.popleft()
        except IndexError:
            return
        future = self.pool.submit(_plans, share)
        self.given[number] = future
        future.add_done_callback(self.hand_out)

    def results_of(self, number: int) -> list[PlanResult]:
        """These results; works on other shares until they are there."""
        while number not in self.made:
            future = self.given.get(number)
            if future is not None and (future.done() or not self.waiting):
                return self.given.pop(number).result()
            try:
                mine, share = self.waiting.popleft()
            except IndexError:
                continue  # another thread is just handing out the last one
            self.made[mine] = _plans(share)
        return self.made.pop(number)
