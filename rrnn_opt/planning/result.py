"""What ``plan`` returns, and its document."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

EXIT_CODES = {
    "solved": 0,
    "uncertified": 1,
    "budget_exhausted": 1,
    "time_limit": 1,
    "no_goal_posture": 1,
    "infeasible": 1,
    "interrupted": 130,
    "invalid_problem": 2,
}
NO_CERTIFICATE: dict[str, Any] = {
    "collision_free": "UNKNOWN",
    "limits": "UNKNOWN",
    "clearance_lower_bound": None,
    "goal_error": None,
    "goal_angle_error": None,
    "method": "none: there is no trajectory",
    "checks": 0,
    "time_s": 0.0,
}


@dataclass(frozen=True)
class PlanStats:
    """Counts and times of a plan.

    Attributes:
        random: random rollouts started.
        heuristic: heuristic and connecting rollouts started.
        nodes: nodes of both trees.
        rollout_steps: certified steps.
        goal_postures: roots that the inverse kinematics found.
        memory_cell: activity before each exploration.
        refinements: searches after the first, for a shorter path.
        first_path_length: of the path as found, rad or m in joint space.
        path_length: of the path kept, likewise, rad or m.
        time_s: whole call.
        plan_time_s: search with its step certificates.
        refine_time_s: shortening, further searches included.
        retime_time_s: retiming.
        compile_time_s: emission and compilation (small when cached).
    """

    random: int = 0
    heuristic: int = 0
    nodes: int = 0
    rollout_steps: int = 0
    goal_postures: int = 0
    memory_cell: tuple[float, ...] = ()
    refinements: int = 0
    first_path_length: float | None = None
    path_length: float | None = None
    time_s: float = 0.0
    plan_time_s: float = 0.0
    refine_time_s: float = 0.0
    retime_time_s: float = 0.0
    compile_time_s: float = 0.0

    @property
    def explorations(self) -> int:
        """Rollouts started, of whatever kind."""
        return self.random + self.heuristic

    def to_dict(self) -> dict[str, Any]:
        """The ``stats`` of a plan document."""
        return {
            "explorations": self.explorations,
            **{k: getattr(self, k) for k in _PLAIN},
            "memory_cell": list(self.memory_cell),
        }


_PLAIN = (
    "random",
    "heuristic",
    "nodes",
    "rollout_steps",
    "goal_postures",
    "refinements",
    "first_path_length",
    "path_length",
    "time_s",
    "plan_time_s",
    "refine_time_s",
    "retime_time_s",
    "compile_time_s",
)


@dataclass(frozen=True)
class PlanResult:
    """Outcome of ``plan``; ``status`` and what was found on the way.

    Attributes:
        status: one of ``EXIT_CODES``.
        message: one sentence.
        path: waypoints, (N, nv), rad or m, or None.
        trajectory: document of the delivered trajectory, or None.
        certificate: document of its certificate.
        stats: counts and times.
        problem: the problem as read.
        robot: robot block of the document.
        seed: seed of the search.
        planner: name of the planner.
        witness: what makes an infeasible problem so, or {}.
        trees: both trees of the search, for pictures, or {}; see ``plan``.
    """

    status: str
    message: str
    problem: dict[str, Any]
    robot: dict[str, Any]
    seed: int
    planner: str
    path: Array | None = None
    trajectory: dict[str, Any] | None = None
    certificate: dict[str, Any] = field(default_factory=lambda: dict(NO_CERTIFICATE))
    stats: PlanStats = PlanStats()
    witness: dict[str, Any] = field(default_factory=dict)
    trees: dict[str, Any] = field(default_factory=dict)

    @property
    def exit_code(self) -> int:
        """Exit status of the command line."""
        return EXIT_CODES[self.status]

    @property
    def solved(self) -> bool:
        """A trajectory was found and proved."""
        return self.status == "solved"

    def to_dict(self) -> dict[str, Any]:
        """The plan document, ready for JSON."""
        document: dict[str, Any] = {
            "status": self.status,
            "message": self.message,
            "path": None if self.path is None else self.path.tolist(),
            "trajectory": self.trajectory,
            "certificate": self.certificate,
            "stats": self.stats.to_dict(),
            "problem": self.problem,
            "robot": self.robot,
            "seed": self.seed,
            "planner": self.planner,
            "versions": versions(),
        }
        for key in ("witness", "trees"):
            if getattr(self, key):
                document[key] = getattr(self, key)
        return document


def versions() -> dict[str, str]:
    """Versions of the package and of what a plan depends on."""
    return dict(_versions())


@lru_cache(maxsize=1)
def _versions() -> tuple[tuple[str, str], ...]:
    from importlib import metadata

    names = ("rrnn_opt", "casadi", "numpy", "toppra")
    return tuple((name, metadata.version(name)) for name in names)
