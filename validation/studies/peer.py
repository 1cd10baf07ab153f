"""OMPL's RRTConnect on a problem of ours, with our compiled checker.

OMPL's wheel calls its validity checker through Python.  The checks are counted
and one check is timed inside C; what OMPL would need with a compiled checker is
at least ``checks * (seconds of one check in C)``, its own bookkeeping not
counted, which favours OMPL.  Its edges are checked every 1/32 rad, not proved.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.planning import Problem, RandomRnn
from rrnn_opt.planning.search.cache import runtime_of
from rrnn_opt.planning.search.feasibility import nearest_turn
from rrnn_opt.planning.search.library import Search
from rrnn_opt.planning.search.request import pack, sampling_box

Array = NDArray[np.float64]
RESOLUTION = 1 / 32
"""Longest way between two checks of an edge, rad."""
SAMPLE = 500


@dataclass(frozen=True)
class PeerRun:
    """One run of RRTConnect.

    Attributes:
        solved: whether it found an exact path.
        checks: postures that it had checked.
        check_s: of one check inside C, s.
        cpu_s: its time with the checker called through Python, s.
    """

    solved: bool
    checks: int
    check_s: float
    cpu_s: float

    @property
    def seconds(self) -> float:
        """Time of its checks alone, all in C, s."""
        return self.checks * self.check_s


def rrt_connect(problem: Problem, goal: Array, limit_s: float) -> PeerRun:
    """One run from the problem's start to a goal posture.

    Args:
        problem: start, robot and scene.
        goal: posture, (nv,), rad or m.
        limit_s: of processor time, the checker's Python included.

    Raises:
        ImportError: ``ompl`` is not installed.
    """
    from ompl import base as ob
    from ompl import util

    util.setLogLevel(util.LOG_NONE)

    goal = nearest_turn(problem.robot, goal, problem.start)
    settings, packed = RandomRnn(), pack(problem, (), (), 0)
    runtime = runtime_of(problem.robot, settings.cell)
    with Search(runtime, settings, packed.struct, packed.keep) as search:
        planner, counted = connecting(problem, [goal], search)
        begin = time.thread_time()
        spent = ob.PlannerTerminationCondition(
            lambda: time.thread_time() - begin > limit_s
        )
        found = bool(planner.solve(spent))
        cpu = time.thread_time() - begin
        solved = found and bool(planner.getProblemDefinition().hasExactSolution())
        return PeerRun(solved, counted[0], _check_cost(problem, goal, search), cpu)


def connecting(
    problem: Problem, goals: Sequence[Array], search: Search
) -> tuple[Any, list[int]]:
    """RRTConnect, set up with our checker, and the number of its checks so far.

    Args:
        problem: start, robot and scene.
        goals: postures, (nv,) each, rad or m; any will do.
        search: whose checker it gets.

    Raises:
        ImportError: ``ompl`` is not installed.
    """
    from ompl import base as ob
    from ompl import geometric as og

    information, counted = _space(problem, goals, search)
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
    return planner, counted


def _space(
    problem: Problem, goals: Sequence[Array], search: Search
) -> tuple[Any, list[int]]:
    """OMPL's space information with our checker, and its counter."""
    from ompl import base as ob

    nv, counted = problem.robot.nv, [0]
    space, bounds = ob.RealVectorStateSpace(nv), ob.RealVectorBounds(nv)
    low, high = sampling_box(problem)
    for k in range(nv):
        bounds.setLow(k, float(min(low[k], *(goal[k] for goal in goals))))
        bounds.setHigh(k, float(max(high[k], *(goal[k] for goal in goals))))
    space.setBounds(bounds)
    information = ob.SpaceInformation(space)

    def valid(state: Any) -> bool:
        counted[0] += 1
        return bool(search.postures_free(np.array([state[k] for k in range(nv)]))[0])

    information.setStateValidityChecker(valid)
    share = RESOLUTION / space.getMaximumExtent()
    information.setStateValidityCheckingResolution(share)
    information.setup()
    return information, counted


def _state(space: Any, q: Array) -> Any:
    state = space.allocState()
    for k, value in enumerate(q):
        state[k] = float(value)
    return state


def _check_cost(problem: Problem, goal: Array, search: Search) -> float:
    """CPU seconds of one check inside C, over postures between the two ends."""
    share = np.linspace(0.0, 1.0, SAMPLE)[:, None]
    postures = problem.start + share * (goal - problem.start)
    begin = time.process_time()
    search.postures_free(postures)
    return (time.process_time() - begin) / SAMPLE
