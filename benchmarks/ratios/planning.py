"""Plans through the two scenarios, beside OMPL's RRTConnect in the same run.

OMPL's wheel calls its validity checker through Python.  It gets our compiled
checker, its checks are counted, and one check is timed inside C.  What OMPL
would need with a compiled checker is at least

    checks * (seconds of one check in C),

its own bookkeeping not counted: the comparison favours OMPL.

OMPL gets goal postures for nothing (20 of ours); our time includes finding
them.  Times are CPU times; neither includes setting the problem up.  Its edges
are checked every 1/32 rad, ours are proved.
"""

from __future__ import annotations

import time
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from benchmarks.record import Benchmark, Row
from rrnn_opt.planning import Problem, RandomRnn
from rrnn_opt.planning.search.cache import runtime_of
from rrnn_opt.planning.search.library import Search
from rrnn_opt.planning.search.request import pack
from rrnn_opt.scene.library import scenario
from rrnn_opt.validation.studies.peer import connecting

Array = NDArray[np.float64]
STARTS, GOALS, LIMIT_S = 20, 20, 5.0


def open_search(problem: Problem, seed: int) -> Search:
    """A search for the problem's tip goal."""
    settings = RandomRnn()
    packed = pack(problem, (), problem.goals, seed)
    runtime = runtime_of(problem.robot, settings.cell)
    return Search(runtime, settings, packed.struct, packed.keep)


def ours(problem: Problem, seed: int) -> tuple[float, Array]:
    """Seconds of one search, inverse kinematics included, and its last posture."""
    with open_search(problem, seed) as search:
        begin = time.thread_time()
        status = "paused"
        while status == "paused":
            status = search.run(20_000, LIMIT_S)
        seconds = time.thread_time() - begin
        return (seconds if status == "solved" else np.inf), search.path()[-1]


def check_cost(search: Search, nv: int, rng: np.random.Generator) -> float:
    """Seconds of one check inside C, over random postures."""
    postures = rng.uniform(-1, 1, (4000, nv))
    begin = time.thread_time()
    search.postures_free(postures)
    return (time.thread_time() - begin) / len(postures)


def theirs(problem: Problem, goals: list[Array], search: Search) -> tuple[float, int]:
    """Seconds of one RRTConnect run to any of the goals, inf on failure; its checks."""
    from ompl import base as ob

    planner, checks = connecting(problem, goals, search)
    begin = time.thread_time()
    solved = planner.solve(ob.timedPlannerTerminationCondition(LIMIT_S))
    return (time.thread_time() - begin if solved else np.inf), checks[0]


def run(benchmark: Benchmark) -> None:
    """Add the rows of both scenarios."""
    from ompl import util

    util.setLogLevel(util.LOG_NONE)
    rng = np.random.default_rng(0)
    for name in ("plane", "window"):
        problems = [Problem.from_dict(scenario(name).problem(i)) for i in range(STARTS)]
        ours(problems[0], 0)  # the compiled code is loaded
        mine = [ours(p, i)[0] for i, p in enumerate(problems)]
        goals = [ours(problems[0], 1000 + i)[1] for i in range(GOALS)]
        with open_search(problems[0], 0) as search:
            cost = check_cost(search, problems[0].robot.nv, rng)
            runs = [theirs(problem, goals, search) for problem in problems]
        benchmark.add(*rows(name, np.array(mine), np.array(runs), cost))


def rows(name: str, mine: Array, runs: Array, cost: float) -> Iterator[Row]:
    """Our seconds beside theirs and their checks, (n, 2), at ``cost`` seconds each."""
    seconds, checks = runs[:, 0], float(np.median(runs[:, 1]))
    for who, times, which in (
        ("random-rnn", mine, "IK included"),
        ("RRTConnect", seconds, "in Python"),
    ):
        yield Row(f"{name}: {who}, {which}", float(np.median(times)), "s")
        yield Row(f"{name}: {who}, solved", float(np.isfinite(times).mean()), "1")
    yield Row(f"{name}: RRTConnect, checks", checks, "1")
    yield Row(f"{name}: one check inside C", cost, "s")
    ratio = float(checks * cost / np.median(mine))
    yield Row(f"{name}: RRTConnect's checks at that cost", checks * cost, "s", ratio)
