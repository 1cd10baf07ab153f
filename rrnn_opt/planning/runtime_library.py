"""The compiled runtime of a robot's planner, called through ctypes."""

from __future__ import annotations

import ctypes as ct
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt import emit
from rrnn_opt.errors import RrnnError
from rrnn_opt.networks import MemoryCell
from rrnn_opt.planning.kernel import PREFIX, source
from rrnn_opt.planning.settings import RandomRnn
from rrnn_opt.robot import Robot

Array = NDArray[np.float64]
STATUS = {0: "paused", 1: "solved", 2: "budget_exhausted", 3: "no_goal_posture"}


class Settings(ct.Structure):
    """``settings_t`` of runtime/types.h."""

    _fields_ = (
        *(
            (name, ct.c_double)
            for name in (
                "max_step",
                "min_step",
                "steering",
                "slack",
                "stall_ratio",
                "node_gap",
                "ik_step",
                "ik_share",
                "coin",
            )
        ),
        *(
            (name, ct.c_int32)
            for name in (
                "max_slide_steps",
                "stall_window",
                "sweeps",
                "rows_per_pass",
                "passes",
                "max_roots",
                "ik_steps",
                "ik_tries",
            )
        ),
    )


class TipTarget(ct.Structure):
    """``tip_goal_t``."""

    _fields_ = (
        ("position", ct.c_double * 3),
        ("rotation", ct.c_double * 9),
        ("tolerance", ct.c_double),
        ("chord", ct.c_double),
        ("has_rotation", ct.c_int32),
        ("reserved", ct.c_int32),
    )


class Request(ct.Structure):
    """``request_t``."""

    _fields_ = (
        *(
            (name, ct.c_void_p)
            for name in (
                "lower",
                "upper",
                "sample_lower",
                "sample_upper",
                "start",
                "kind",
                "shape",
                "joint_goals",
                "tip_goals",
            )
        ),
        ("margin", ct.c_double),
        ("seed", ct.c_uint64 * 2),
        ("obstacle_count", ct.c_int32),
        ("joint_goal_count", ct.c_int32),
        ("tip_goal_count", ct.c_int32),
        ("reserved", ct.c_int32),
    )


class Closest(ct.Structure):
    """``closest_t``."""

    _fields_ = (
        ("gap", ct.c_double),
        ("sphere", ct.c_int32),
        ("other", ct.c_int32),
        ("is_self", ct.c_int32),
        ("reserved", ct.c_int32),
    )


@dataclass(frozen=True)
class Contact:
    """The closest pair at a posture.

    Attributes:
        gap: clearance less the promised margin, m.
        sphere: index of the robot's sphere.
        other: index of the obstacle, or of the second sphere.
        is_self: the pair is a self pair.
    """

    gap: float
    sphere: int
    other: int
    is_self: bool


@dataclass(frozen=True)
class SearchCounts:
    """What the search did: rollouts, nodes, steps and goal postures."""

    random: int
    heuristic: int
    nodes: int
    rollout_steps: int
    goal_postures: int
    ik_failures: int


class Runtime:
    """The compiled planner of one robot; stateless, any number of searches."""

    def __init__(self, robot: Robot, cell: MemoryCell) -> None:
        self.robot = robot
        self.built = emit.build(source(robot, cell), name=f"planner_{robot.nv}")
        self._library = emit.load(self.built)

    def function(self, name: str, result: Any, *arguments: Any) -> Any:
        """Exported function ``name`` with its C types declared."""
        function = getattr(self._library, PREFIX + name)
        function.restype, function.argtypes = result, arguments
        return function

    @cached_property
    def create(self) -> Any:
        """``create(settings, request)``."""
        pointers = (ct.POINTER(Settings), ct.POINTER(Request))
        return self.function("create", ct.c_void_p, *pointers)

    @cached_property
    def free(self) -> Any:
        """``free(search)``."""
        return self.function("free", None, ct.c_void_p)


def settings_struct(settings: RandomRnn) -> Settings:
    """``settings_t`` of a planner's settings."""
    return Settings(
        max_step=settings.max_step,
        min_step=settings.min_step,
        steering=settings.steering_margin,
        slack=settings.slack,
        stall_ratio=settings.stall_ratio,
        node_gap=settings.node_gap,
        ik_step=settings.ik_step,
        ik_share=settings.ik_share,
        coin=-1.0 if settings.coin is None else settings.coin,
        max_slide_steps=settings.max_slide_steps,
        stall_window=settings.stall_window,
        sweeps=settings.sweeps,
        rows_per_pass=settings.rows_per_pass,
        passes=settings.passes,
        max_roots=settings.max_roots,
        ik_steps=settings.ik_steps,
        ik_tries=settings.ik_tries,
    )


class Search:
    """One search in the runtime; use it as a context manager.

    Args:
        runtime: the compiled planner.
        settings: its numbers.
        request: start, goals, limits and obstacles.
        keep: arrays that ``request`` points into; kept alive here.
    """

    def __init__(
        self, runtime: Runtime, settings: RandomRnn, request: Request, keep: Any
    ) -> None:
        self._runtime, self._keep = runtime, (request, keep)
        struct = settings_struct(settings)
        self._handle = runtime.create(ct.byref(struct), ct.byref(request))
        if not self._handle:
            raise RrnnError("planner: out of memory; give fewer obstacles")
        self._nv = runtime.robot.nv

    def __enter__(self) -> Search:
        return self

    def __exit__(self, *_: object) -> None:
        self._runtime.free(self._handle)
        self._handle = None

    def _call(self, name: str, result: Any, types: tuple[Any, ...], *args: Any) -> Any:
        return self._runtime.function(name, result, ct.c_void_p, *types)(
            self._handle, *args
        )

    def run(self, budget: int, slice_s: float) -> str:
        """Search on; "paused" after ``slice_s`` seconds."""
        types = (ct.c_int64, ct.c_double)
        code = int(self._call("run", ct.c_int32, types, budget, slice_s))
        if code not in STATUS:
            raise RrnnError("planner: out of memory; lower the exploration budget")
        return STATUS[code]

    def segment_free(self, start: Array, end: Array) -> bool:
        """Proof by bisection that the straight segment is free."""
        types = (ct.c_void_p, ct.c_void_p)
        a, b = (np.ascontiguousarray(q, dtype=np.float64) for q in (start, end))
        return bool(
            self._call("segment_free", ct.c_int32, types, a.ctypes.data, b.ctypes.data)
        )

    def closest(self, q: Array, radius: float = 0.1) -> Contact | None:
        """Closest pair at ``q`` among those that ``radius`` rad could close."""
        out, types = Closest(), (ct.c_void_p, ct.c_double, ct.POINTER(Closest))
        q = np.ascontiguousarray(q, dtype=np.float64)
        self._call("closest", ct.c_int32, types, q.ctypes.data, radius, ct.byref(out))
        if out.sphere < 0:
            return None
        return Contact(out.gap, out.sphere, out.other, bool(out.is_self))

    def path(self) -> Array:
        """Waypoints of the path found, (N, nv)."""
        count, types = ct.c_int32(), (ct.POINTER(ct.c_int32),)
        pointer = self._call("path", ct.POINTER(ct.c_double), types, ct.byref(count))
        if count.value == 0:
            return np.zeros((0, self._nv))
        return np.ctypeslib.as_array(pointer, (count.value, self._nv)).copy()

    def counts(self) -> SearchCounts:
        """Rollouts, nodes and steps so far."""
        out = np.zeros(6, dtype=np.int64)
        self._call("counts", None, (ct.c_void_p,), out.ctypes.data)
        return SearchCounts(*(int(v) for v in out))

    def activity(self) -> Array:
        """Memory cell's activity before each exploration."""
        counts = self.counts()
        total = counts.random + counts.heuristic
        if total == 0:
            return np.zeros(0)
        pointer = self._call("cells", ct.POINTER(ct.c_double), ())
        return np.ctypeslib.as_array(pointer, (total,)).copy()

    def trees(self) -> tuple[tuple[Array, NDArray[np.int64]], ...]:
        """Nodes (N, nv) and parents (N,) of the start's and the goals' tree."""
        types = (ct.c_int32, ct.c_int32, ct.c_void_p, ct.POINTER(ct.c_int32))
        result = []
        for side in (0, 1):
            parent, q = ct.c_int32(), np.zeros(self._nv)
            arguments = (q.ctypes.data, ct.byref(parent))
            total = self._call("node", ct.c_int32, types, side, -1, *arguments)
            nodes, parents = np.zeros((total, self._nv)), np.zeros(total, np.int64)
            for i in range(total):
                self._call("node", ct.c_int32, types, side, i, *arguments)
                nodes[i], parents[i] = q, parent.value
            result.append((nodes, parents))
        return tuple(result)
