"""Plans through the two scenarios, beside OMPL's RRTConnect in the same run.

OMPL's wheel calls its validity checker through Python.  It gets our compiled
checker, its checks are counted, one check is timed inside C, and the time
that OMPL would need at the compiled checker's cost is

    total - checks * (cost of one call from Python - cost of one check in C).

OMPL gets goal postures for nothing (20 of ours); our time includes finding
them.  Its edges are checked every 1/32 rad, ours are proved.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import Any

import numpy as np
from benchmarks.record import Benchmark, Row
from numpy.typing import NDArray

from rrnn_opt.planning import Problem, RandomRnn
from rrnn_opt.planning.request import pack
from rrnn_opt.planning.runtime_cache import runtime_of
from rrnn_opt.planning.runtime_library import Search
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
    begin = time.perf_counter()
    with open_search(problem, seed) as search:
        status = "paused"
        while status == "paused":
            status = search.run(20_000, LIMIT_S)
        seconds = time.perf_counter() - begin
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


def call_costs(
    information: Any, checker: Counted, rng: np.random.Generator
) -> tuple[float, float]:
    """Seconds of a check when OMPL asks for it, and of the same one inside C.

    OMPL walks random edges; each of its checks crosses into Python and back.
    """
    space, before, edges = information.getStateSpace(), checker.checks, []
    for _ in range(400):
        edges.append([_state(space, rng.uniform(-1, 1, checker.nv)) for _ in "ab"])
    begin = time.perf_counter()
    for a, b in edges:
        information.checkMotion(a, b)
    outside = (time.perf_counter() - begin) / (checker.checks - before)
    postures = rng.uniform(-1, 1, (4000, checker.nv))
    begin = time.perf_counter()
    checker.search.postures_free(postures)
    return outside, (time.perf_counter() - begin) / len(postures)


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
    begin = time.perf_counter()
    solved = planner.solve(ob.timedPlannerTerminationCondition(LIMIT_S))
    return time.perf_counter() - begin if solved else np.inf


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
            probe = Counted(search, problems[0].robot.nv)
            outside, inside = call_costs(ompl_space(problems[0], probe), probe, rng)
            for problem in problems:
                counted = Counted(search, problem.robot.nv)
                theirs.append(rrt_connect(problem, goals, counted))
                checks.append(counted.checks)
        spared = np.array(checks) * (outside - inside)
        compiled = np.array(theirs) - spared
        times = np.array([seconds for seconds, _ in mine])
        benchmark.add(
            Row(f"{name}: random-rnn, IK included", float(np.median(times)), "s"),
            Row(f"{name}: random-rnn, solved", float(np.isfinite(times).mean()), "1"),
            Row(f"{name}: RRTConnect in Python", float(np.median(theirs)), "s"),
            Row(f"{name}: RRTConnect, solved", float(np.isfinite(theirs).mean()), "1"),
            Row(f"{name}: RRTConnect, checks", float(np.median(checks)), "1"),
            Row(f"{name}: one check inside C", inside, "s"),
            Row(
                f"{name}: RRTConnect at that cost",
                float(np.median(compiled)),
                "s",
                ratio=float(np.median(compiled) / np.median(times)),
            ),
        )
