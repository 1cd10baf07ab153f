"""Many plans at once, on all cores."""

from __future__ import annotations

import os
import sys
import threading
from collections import deque
from collections.abc import Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from dataclasses import dataclass, field
from multiprocessing import get_context
from typing import Any

from rrnn_opt.arguments import checked
from rrnn_opt.errors import ProblemError
from rrnn_opt.motion import toppra_loading
from rrnn_opt.planning.planner import plan
from rrnn_opt.planning.problem.problem import Problem
from rrnn_opt.planning.result import PlanResult
from rrnn_opt.planning.search.cache import judge_of
from rrnn_opt.planning.searches import runtime_for
from rrnn_opt.planning.settings.planners import PLANNERS

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

    Results do not depend on the number of jobs.  This process is one of them.  On
    Linux, where it has no other thread, the others are copies of it, with libraries
    and compiled planners loaded.  Elsewhere they are started afresh while this one
    plans, find the compiled planner in the cache and take work when they are ready;
    a program that calls this then needs the usual ``if __name__ == "__main__":``.

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


def _start_method() -> str:
    """How the other processes start: as copies where that is safe.

    A copy has none of the other threads, and what they hold locked stays locked.
    """
    alone = sys.platform == "linux" and threading.active_count() == 1
    return "fork" if alone else "spawn"


def _prepare(shares: list[list[Job]]) -> None:
    """Load here what all copies of this process will need."""
    toppra_loading.load()
    for job in {
        id(job.problem.robot): job for share in shares for job in share
    }.values():
        named = PLANNERS.get(job.options.get("planner", "random-rnn"))
        settings = job.options.get("settings") or named
        if settings is not None:  # else plan refuses the name
            runtime_for(job.problem.robot, settings)
        judge_of(job.problem.robot)


def _among(shares: list[list[Job]], others: int) -> Iterator[list[PlanResult]]:
    """Results of the shares in order, made by other processes and by this one."""
    method = _start_method()
    if method == "fork":
        _prepare(shares)
    with ProcessPoolExecutor(others, mp_context=get_context(method)) as pool:
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
