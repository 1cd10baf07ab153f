"""Rollouts of the printed schemes in the compiled runtime."""

from __future__ import annotations

import ctypes as ct
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.errors import ProblemError, RrnnError
from rrnn_opt.networks import MemoryCell
from rrnn_opt.planning.rollout.kernel import rollout_source
from rrnn_opt.planning.rollout.structs import RolloutStruct, rollout_struct
from rrnn_opt.planning.search.cache import RobotKey
from rrnn_opt.planning.search.feasibility import OpenGoals
from rrnn_opt.planning.search.library import (
    STATUS,
    Runtime,
    Search,
    Tree,
)
from rrnn_opt.planning.search.structs import Request
from rrnn_opt.planning.settings.random_rnn import RandomRnn
from rrnn_opt.planning.settings.rollout import PaperRnn, RolloutSettings
from rrnn_opt.robot import Robot

Array = NDArray[np.float64]
CHORD = 0.1
"""Longest chord of a path that is handed on, rad."""


class RolloutRuntime(Runtime):
    """The compiled planner with the printed schemes' rollouts."""

    def __init__(self, robot: Robot, cell: MemoryCell, c1: float, c2: float) -> None:
        text = rollout_source(robot, cell, c1, c2)
        self._load(robot, text, f"rollouts_{robot.nv}")


@lru_cache(maxsize=16)
def _runtime(key: RobotKey) -> RolloutRuntime:
    return RolloutRuntime(key.robot, *key.constants)


def rollout_runtime_of(robot: Robot, settings: RolloutSettings) -> RolloutRuntime:
    """The compiled rollouts of a robot, built at their first use.

    Raises:
        CompilerError: there is no C compiler, or it failed.
    """
    return _runtime(RobotKey.of(robot, settings.cell, settings.c1, settings.c2))


class RolloutSearch(Search):
    """One search by rollouts; use it as a context manager.

    Args:
        runtime: the compiled rollouts.
        settings: their numbers.
        request: start, goals, limits and obstacles.
        keep: arrays that ``request`` points into; kept alive here.

    Raises:
        RrnnError: out of memory.
    """

    def __init__(
        self, runtime: Runtime, settings: RolloutSettings, request: Request, keep: Any
    ) -> None:
        coin = settings.coin if isinstance(settings, PaperRnn) else None
        super().__init__(runtime, RandomRnn(coin=coin), request, keep)
        struct = rollout_struct(runtime.robot, settings)
        create = runtime.function(
            "rollouts_create", ct.c_void_p, ct.c_void_p, ct.POINTER(RolloutStruct)
        )
        self._rollouts = create(self._handle, ct.byref(struct))
        if not self._rollouts:
            super().__exit__()
            raise RrnnError("planner: out of memory; give fewer obstacles")

    def __enter__(self) -> RolloutSearch:
        return self

    def __exit__(self, *_: object) -> None:
        self._runtime.function("rollouts_free", None, ct.c_void_p)(self._rollouts)
        self._rollouts = None
        super().__exit__()

    def _rolled(
        self, name: str, result: Any, types: tuple[Any, ...], *args: Any
    ) -> Any:
        function = self._runtime.function(name, result, ct.c_void_p, *types)
        return function(self._rollouts, *args)

    def run(self, budget: int, slice_s: float, limit_s: float = np.inf) -> str:
        """Explore on; "paused" after ``slice_s`` or ``limit_s`` seconds.

        Raises:
            RrnnError: out of memory.
        """
        types, slice_s = (ct.c_int64, ct.c_double), min(slice_s, limit_s)
        code = int(self._rolled("rollouts_run", ct.c_int32, types, budget, slice_s))
        if code not in STATUS:
            raise RrnnError("planner: out of memory; lower the exploration budget")
        return STATUS[code]

    def velocity(self, q: Array, u: Array, target: Array) -> tuple[Array, float]:
        """Joint velocity after one step of the scheme, and the task error.

        Args:
            q: posture, (nv,), rad or m.
            u: joint velocity before, (nv,), rad/s or m/s.
            target: position, (3,), m.
        """
        q, target = (np.ascontiguousarray(v, dtype=np.float64) for v in (q, target))
        after = np.array(u, dtype=np.float64)
        pointers = (q.ctypes.data, after.ctypes.data, target.ctypes.data)
        types = (ct.c_void_p,) * 3
        error = self._rolled("rollouts_step", ct.c_double, types, *pointers)
        return after, float(error)

    def nodes(self) -> tuple[Array, NDArray[np.int64]]:
        """Postures (N, nv) and parents (N,) of the tree T_s."""
        total = int(self._rolled("rollouts_count", ct.c_int32, ()))
        postures, parents = np.zeros((total, self._nv)), np.zeros(total, np.int64)
        types = (ct.c_int32, ct.c_void_p)
        for i in range(total):
            pointer = postures[i].ctypes.data
            parents[i] = self._rolled("rollouts_node", ct.c_int32, types, i, pointer)
        return postures, parents

    def trees(self, most: int | None = None) -> tuple[Tree, Tree]:
        """T_s, and the tree from the goals, which the print does not have."""
        postures, parents = self.nodes()
        none = np.zeros((0, self._nv)), np.zeros(0, np.int64)
        return (postures[:most], parents[:most]), none

    def way(self, node: int) -> Array:
        """Waypoints from the start to a node of T_s, (N, nv).

        Raises:
            IndexError: T_s has no such node.
            RrnnError: out of memory.
        """
        total = int(self._rolled("rollouts_count", ct.c_int32, ()))
        if not 0 <= node < total:
            raise IndexError(f"T_s has nodes 0 to {total - 1}, not {node}")
        if not self._rolled("rollouts_trace", ct.c_int32, (ct.c_int32,), node):
            raise RrnnError("planner: out of memory while tracing the path")
        return self.path()


def point_goals(goals: OpenGoals, planner: str) -> OpenGoals:
    """The goals that a position scheme can be given.

    Raises:
        ProblemError: there is none; the printed schemes know neither postures
            nor orientations.
    """
    tips = tuple(tip for tip in goals.tips if tip.quat_xyzw is None)
    if not tips:
        message = f"'{planner}' goes to positions; give one without quat_xyzw"
        raise ProblemError("goal", message)
    return OpenGoals((), tips)


def thinned(search: Search, path: Array, chord: float = CHORD) -> Array:
    """The path with fewer waypoints; every new chord is proved free.

    Args:
        search: proves segments.
        path: waypoints, (N, nv), every segment proved.
        chord: longest new segment, rad.
    """
    ways = np.linalg.norm(np.diff(path, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(ways)])
    kept, at, last = [0], 0, len(path) - 1
    while at < last:
        end = int(np.searchsorted(along, along[at] + chord, side="right")) - 1
        end = min(max(end, at + 1), last)
        while end > at + 1 and not search.segment_free(path[at], path[end]):
            end = (at + end + 1) // 2 if end > at + 2 else at + 1
        kept.append(end)
        at = end
    return path[kept]
