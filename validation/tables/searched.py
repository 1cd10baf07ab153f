"""One search without delivery, timed by the processor time of its thread."""

from __future__ import annotations

import time
from typing import Any

from rrnn_opt.errors import ProblemError
from rrnn_opt.planning import Problem
from rrnn_opt.planning.rollout.library import point_goals
from rrnn_opt.planning.search.feasibility import Infeasible, open_goals
from rrnn_opt.planning.search.request import pack
from rrnn_opt.planning.searches import open_search, runtime_for
from rrnn_opt.planning.settings.planners import PlannerSettings
from rrnn_opt.planning.settings.random_rnn import RandomRnn

SLICE_S = 3600.0


def searched(
    problem: Problem, settings: PlannerSettings, seed: int, budget: int
) -> dict[str, Any]:
    """Outcome, explorations and processor time of one search.

    The search is the one that ``plan`` makes from the same seed.

    Args:
        problem: with a goal that is not proved out of reach.
        settings: of the planner.
        seed: of the search.
        budget: explorations at most.

    Raises:
        ProblemError: every goal is proved out of reach.
    """
    runtime = runtime_for(problem.robot, settings)
    with open_search(runtime, settings, pack(problem, (), (), seed)) as probe:
        goals = open_goals(problem, probe)
    if isinstance(goals, Infeasible):
        raise ProblemError("goal", goals.message)
    if not isinstance(settings, RandomRnn):
        goals = point_goals(goals, type(settings).__name__)
    packed = pack(problem, goals.joints, goals.tips, seed)
    begin = time.thread_time()
    with open_search(runtime, settings, packed) as search:
        status = search.run(budget, SLICE_S)
        seconds = time.thread_time() - begin
        counts = search.counts()
    return {
        "status": status,
        "solved": status == "solved",
        "random": counts.random,
        "heuristic": counts.heuristic,
        "total": counts.random + counts.heuristic,
        "plan_ms": 1e3 * seconds,
    }
