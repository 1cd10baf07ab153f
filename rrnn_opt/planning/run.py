"""A plan under way: what it has so far, and the result that this makes."""

from __future__ import annotations

import time
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.motion import Trajectory
from rrnn_opt.planning.problem.problem import Problem
from rrnn_opt.planning.result import PlanResult, PlanStats
from rrnn_opt.planning.search.structs import SearchCounts
from rrnn_opt.planning.settings.planners import PlannerSettings

Array = NDArray[np.float64]


@dataclass
class Run:
    """What a plan has so far; a result can be made of it at any time."""

    problem: Problem
    seed: int
    planner: str
    settings: PlannerSettings
    begin: float
    improve_s: float = 0.0
    counts: SearchCounts | None = None
    activity: tuple[float, ...] = ()
    path: Array | None = None
    trajectory: Trajectory | None = None
    certificate: dict[str, Any] | None = None
    keep_trees: bool = False
    trees: dict[str, Any] = field(default_factory=dict)
    figures: dict[str, Any] = field(default_factory=dict)

    def result(self, status: str, message: str, **more: Any) -> PlanResult:
        """The result with this status, holding what was found so far."""
        if self.certificate is not None:
            more["certificate"] = self.certificate
        return PlanResult(
            status=status,
            message=message,
            problem=self.problem.to_dict(),
            robot=self.problem.robot.to_dict(),
            seed=self.seed,
            planner=self.planner,
            path=self.path,
            trajectory=None if self.trajectory is None else self.trajectory.to_dict(),
            stats=self._stats(),
            trees=self.trees,
            **more,
        )

    def _stats(self) -> PlanStats:
        stats = PlanStats(time_s=time.perf_counter() - self.begin, **self.figures)
        if self.counts is None:
            return stats
        counts = self.counts
        return replace(
            stats,
            random=counts.random,
            heuristic=counts.heuristic,
            nodes=counts.nodes,
            rollout_steps=counts.rollout_steps,
            goal_postures=counts.goal_postures,
            memory_cell=self.activity,
        )
