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
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.record import Benchmark, Row
from rrnn_opt.planning import Problem, RandomRnn
from rrnn_opt.planning.search.cache import runtime_of
from rrnn_opt.planning.search.library import Search
from rrnn_opt.planning.search.request import pack
from rrnn_opt.scene.library import scenario

Array = NDArray[np.float64]
STARTS, GOALS, LIMIT_S, RESOLUTION = 20, 20, 5.0, 1 / 32


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


@dataclass
class Counted:
    """Our compiled checker as OMPL sees it, and how often it was asked."""

    search: Search
    nv: int
    checks: int = 0

    def __call__(self, state: Any) -> bool:
        self.checks += 1
        q = np.array([state[k] for k in range(self.nv)])
        return bool(self.search.postures_free(q)[0])


def check_cost(search: Search, nv: int, rng: np.random.Generator) -> float:
    """Seconds of one check inside C, over random postures."""
    postures = rng.uniform(-1, 1, (4000, nv))
    begin = time.thread_time()
    search.postures_free(postures)
    return (time.thread_time() - begin) / len(postures)


def ompl_space(problem: Problem, checker: Counted) -> Any:
    """OMPL's space information with our checker."""
    from ompl import base as ob

    limits, nv = problem.robot.limits, problem.robot.nv
    space = ob.RealVectorStateSpace(nv)
    bounds = ob.RealVectorBounds(nv)
    for k in range(nv):
        bounds.setLow(k, float(limits.lower[k]))
        bounds.setHigh(k, float(limits.upper[k]))
    space.setBounds(bounds)
    information = ob.SpaceInformation(space)
    information.setStateValidityChecker(checker)
    share = RESOLUTION / space.getMaximumExtent()
    information.setStateValidityCheckingResolution(share)
    information.setup()
    return information


def rrt_connect(problem: Problem, goals: list[Array], checker: Counted) -> float:
    """Seconds of one RRTConnect run to any of the goals; inf when it fails."""
    from ompl import base as ob
    from ompl import geometric as og

    information = ompl_space(problem, checker)
    space = information.getStateSpace()
    definition = ob.ProblemDefinition(information)
    definition.addStartState(_state(space, problem.start))
    targets = ob.GoalStates(information)
    for goal in goals:
        targets.addState(_state(space, goal))
    definition.setGoal(targets)
    planner = og.RRTConnect(information)
    planner.setProblemDefinition(definition)
    planner.setup()
    begin = time.thread_time()
    solved = planner.solve(ob.timedPlannerTerminationCondition(LIMIT_S))
    return time.thread_time() - begin if solved else np.inf


def _state(space: Any, q: Array) -> Any:
    state = space.allocState()
    for k, value in enumerate(q):
        state[k] = float(value)
    return state


def run(benchmark: Benchmark) -> None:
    """Add the rows of both scenarios."""
    from ompl import util

    util.setLogLevel(util.LOG_NONE)
    rng = np.random.default_rng(0)
    for name in ("plane", "window"):
        problems = [Problem.from_dict(scenario(name).problem(i)) for i in range(STARTS)]
        ours(problems[0], 0)  # the compiled code is loaded
        mine = [ours(p, i) for i, p in enumerate(problems)]
        goals = [ours(problems[0], 1000 + i)[1] for i in range(GOALS)]
        theirs, checks = [], []
        with open_search(problems[0], 0) as search:
            cost = check_cost(search, problems[0].robot.nv, rng)
            for problem in problems:
                counted = Counted(search, problem.robot.nv)
                theirs.append(rrt_connect(problem, goals, counted))
                checks.append(counted.checks)
        times = np.array([seconds for seconds, _ in mine])
        benchmark.add(
            Row(f"{name}: random-rnn, IK included", float(np.median(times)), "s"),
            Row(f"{name}: random-rnn, solved", float(np.isfinite(times).mean()), "1"),
            Row(f"{name}: RRTConnect in Python", float(np.median(theirs)), "s"),
            Row(f"{name}: RRTConnect, solved", float(np.isfinite(theirs).mean()), "1"),
            Row(f"{name}: RRTConnect, checks", float(np.median(checks)), "1"),
            Row(f"{name}: one check inside C", cost, "s"),
            Row(
                f"{name}: RRTConnect's checks at that cost",
                float(np.median(checks) * cost),
                "s",
                ratio=float(np.median(checks) * cost / np.median(times)),
            ),
        )
