"""The compiled runtime of a robot's planner, called through ctypes."""

from __future__ import annotations

import ctypes as ct
import threading
from functools import cached_property
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from rrnn_opt import emit
from rrnn_opt.emit.compiler import cpu_name
from rrnn_opt.errors import RrnnError
from rrnn_opt.networks import MemoryCell
from rrnn_opt.planning.kernel.source import PREFIX, source
from rrnn_opt.planning.search.flags import build_flags
from rrnn_opt.planning.search.structs import (
    NEAR_MAX,
    Closest,
    Contact,
    Near,
    NearPair,
    Request,
    SearchCounts,
    Settings,
    doubles_at,
    settings_struct,
)
from rrnn_opt.planning.settings.random_rnn import RandomRnn
from rrnn_opt.robot import Robot

Array = NDArray[np.float64]
Tree = tuple[Array, NDArray[np.int64]]
SLICE_S = 0.02
"""A search returns to Python so often, for progress and for signals."""
STATUS = {
    0: "paused",
    1: "solved",
    2: "budget_exhausted",
    3: "no_goal_posture",
    5: "cancelled",
}


class Runtime:
    """The compiled planner of one robot; stateless, any number of searches."""

    def __init__(self, robot: Robot, cell: MemoryCell) -> None:
        self._load(robot, source(robot, cell), f"planner_{robot.nv}")

    def _load(self, robot: Robot, text: str, name: str) -> None:
        flags = build_flags(emit.find_compiler().kind, cpu_name())
        self.robot = robot
        self.built = emit.build(text, name=name, flags=flags)
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


class Search:
    """One search in the runtime; use it as a context manager.

    Args:
        runtime: the compiled planner.
        settings: its numbers.
        request: start, goals, limits and obstacles.
        keep: arrays that ``request`` points into; kept alive here.

    Raises:
        RrnnError: out of memory.
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
        main = threading.current_thread() is threading.main_thread()
        self._call("interruptible", None, (ct.c_int32,), int(main))

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self._runtime.free(self._handle)
        self._handle = None

    def _call(self, name: str, result: Any, types: tuple[Any, ...], *args: Any) -> Any:
        return self._runtime.function(name, result, ct.c_void_p, *types)(
            self._handle, *args
        )

    def run(self, budget: int, slice_s: float, limit_s: float = np.inf) -> str:
        """Search on; "paused" after ``slice_s`` seconds, at the end of a slide.

        After ``limit_s`` seconds, or at Ctrl-C in the main thread, it ends in the
        middle of a slide, "cancelled": a search that goes on then is another one.

        Raises:
            RrnnError: out of memory.
        """
        types = (ct.c_int64, ct.c_double, ct.c_double)
        code = int(self._call("run", ct.c_int32, types, budget, slice_s, limit_s))
        if code not in STATUS:
            raise RrnnError("planner: out of memory; lower the exploration budget")
        return STATUS[code]

    def segment_free(self, start: Array, end: Array, extra: float = 0.0) -> bool:
        """Proof by bisection that the straight segment is free.

        ``extra`` (m) is kept from obstacles beyond the promised margin.
        """
        types = (ct.c_void_p, ct.c_void_p, ct.c_double)
        a, b = (np.ascontiguousarray(q, dtype=np.float64) for q in (start, end))
        pointers = (a.ctypes.data, b.ctypes.data)
        return bool(self._call("segment_free", ct.c_int32, types, *pointers, extra))

    def postures_free(self, q: Array) -> NDArray[np.bool_]:
        """Which postures (N, nv) keep every promised clearance, (N,)."""
        q = np.ascontiguousarray(q, dtype=np.float64).reshape(-1, self._nv)
        out = np.zeros(len(q), np.bool_)
        types = (ct.c_void_p, ct.c_int32, ct.c_void_p)
        pointers = (q.ctypes.data, len(q), out.ctypes.data)
        self._call("postures_free", None, types, *pointers)
        return out

    def closest(self, q: Array, radius: float = 0.1) -> Contact | None:
        """Closest pair at ``q`` among those that ``radius`` rad could close."""
        out, types = Closest(), (ct.c_void_p, ct.c_double, ct.POINTER(Closest))
        q = np.ascontiguousarray(q, dtype=np.float64)
        self._call("closest", ct.c_int32, types, q.ctypes.data, radius, ct.byref(out))
        if out.sphere < 0:
            return None
        return Contact(out.gap, out.sphere, out.other, bool(out.is_self))

    def step(self, q: Array, wish: Array) -> tuple[Array, list[NearPair]]:
        """One projected step at ``q`` for the wish, and the pairs it saw."""
        u, near = np.zeros(self._nv), (Near * NEAR_MAX)()
        q, wish = (np.ascontiguousarray(v, dtype=np.float64) for v in (q, wish))
        pointers = (q.ctypes.data, wish.ctypes.data, u.ctypes.data, near)
        count = self._call("step", ct.c_int32, (ct.c_void_p,) * 4, *pointers)
        bound = self._runtime.function(
            "bound", ct.c_double, ct.POINTER(Near), ct.c_void_p
        )
        return u, [
            NearPair(
                pair.sphere,
                pair.other,
                pair.group,
                pair.gap,
                np.array(pair.normal),
                bound(ct.byref(pair), wish.ctypes.data),
            )
            for pair in near[: max(count, 0)]
        ]

    def path(self) -> Array:
        """Waypoints of the path found, (N, nv)."""
        count, types = ct.c_int32(), (ct.POINTER(ct.c_int32),)
        address = self._call("path", ct.c_void_p, types, ct.byref(count))
        return doubles_at(address, (count.value, self._nv))

    def shorten(self, path: Array, attempts: int) -> Array:
        """A proved path, shortened by random slides between its points.

        Args:
            path: waypoints, (N, nv), N >= 2, every segment proved.
            attempts: slides to try.

        Returns:
            Waypoints, (M, nv), same ends, never longer.

        Raises:
            RrnnError: out of memory.
        """
        path = np.ascontiguousarray(path, dtype=np.float64)
        types = (ct.c_void_p, ct.c_int32, ct.c_int32)
        arguments = (path.ctypes.data, len(path), attempts)
        if not self._call("shorten", ct.c_int32, types, *arguments):
            raise RrnnError("planner: out of memory while shortening the path")
        return self.path()

    def counts(self) -> SearchCounts:
        """Rollouts, nodes and steps so far."""
        out = np.zeros(6, dtype=np.int64)
        self._call("counts", None, (ct.c_void_p,), out.ctypes.data)
        return SearchCounts(*(int(v) for v in out))

    def activity(self) -> Array:
        """Memory cell's activity before each exploration."""
        counts = self.counts()
        total = counts.random + counts.heuristic
        return doubles_at(self._call("cells", ct.c_void_p, ()), (total,))

    def trees(self, most: int | None = None) -> tuple[Tree, Tree]:
        """Nodes (N, nv) and parents (N,) of the start's and the goals' tree.

        Args:
            most: nodes of each, the first ones; all without it.
        """
        return self._tree(0, most), self._tree(1, most)

    def _tree(self, side: int, most: int | None) -> Tree:
        types = (ct.c_int32, ct.c_int32, ct.c_void_p, ct.POINTER(ct.c_int32))
        parent, q = ct.c_int32(), np.zeros(self._nv)
        arguments = (q.ctypes.data, ct.byref(parent))
        total = self._call("node", ct.c_int32, types, side, -1, *arguments)
        total = total if most is None else min(total, most)
        nodes, parents = np.zeros((total, self._nv)), np.zeros(total, np.int64)
        for i in range(total):
            self._call("node", ct.c_int32, types, side, i, *arguments)
            nodes[i], parents[i] = q, parent.value
        return nodes, parents
