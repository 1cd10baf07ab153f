"""Where a single rollout ends up, whether it reaches its goal or not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.planning import PlanResult, Problem, plan
from rrnn_opt.planning.rollout.library import RolloutSearch, rollout_runtime_of
from rrnn_opt.planning.search.request import pack
from rrnn_opt.planning.settings.rollout import RolloutSettings

Array = NDArray[np.float64]


def rolled(problem: Problem, settings: RolloutSettings, *, seed: int = 0) -> Array:
    """Waypoints of the first rollout, (N, nv); the start alone if it did not move.

    Args:
        problem: with position goals.
        settings: of the scheme.
        seed: of the search.
    """
    runtime = rollout_runtime_of(problem.robot, settings)
    packed = pack(problem, (), tuple(problem.goals), seed)  # type: ignore[arg-type]
    with RolloutSearch(runtime, settings, packed.struct, packed.keep) as search:
        search.run(1, 3600.0)
        last = len(search.nodes()[0]) - 1
        return search.way(last)


def planned_or_rolled(
    problem: Problem, settings: RolloutSettings, *, seed: int = 0
) -> PlanResult:
    """The plan; where it failed, with the way of the rollout as its path."""
    result = plan(problem, seed=seed, settings=settings, max_explorations=1)
    if result.path is not None:
        return result
    return replace(result, path=rolled(problem, settings, seed=seed))
