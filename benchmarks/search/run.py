"""One search, run several times, and what it took."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from rrnn_opt.planning import Problem, RandomRnn
from rrnn_opt.planning.search.cache import runtime_of
from rrnn_opt.planning.search.library import Search
from rrnn_opt.planning.search.request import pack

REPEATS, BUDGET, LIMIT_S = 5, 20_000, 10.0


@dataclass(frozen=True)
class Found:
    """One search: did it end well, and what it took."""

    status: str
    ms: float
    explorations: int
    steps: int


def searched(problem: Problem, seed: int) -> Found:
    """Least CPU time of some runs of one search; all runs do the same."""
    joints = tuple(g.joints for g in problem.goals if hasattr(g, "joints"))
    tips = tuple(g for g in problem.goals if not hasattr(g, "joints"))
    settings, least = RandomRnn(), np.inf
    packed = pack(problem, joints, tips, seed)
    runtime = runtime_of(problem.robot, settings.cell)
    for _ in range(REPEATS):
        with Search(runtime, settings, packed.struct, packed.keep) as search:
            begin, status = time.thread_time(), "paused"
            while status == "paused":
                status = search.run(BUDGET, LIMIT_S)
            least = min(least, 1e3 * (time.thread_time() - begin))
            counts = search.counts()
    total = counts.random + counts.heuristic
    return Found(status, least, total, counts.rollout_steps)
