"""Our exact solver as a session: the C of the controller's fallback, on the host."""

from __future__ import annotations

import ctypes
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np

from rrnn_opt.arguments import checked
from rrnn_opt.emit import build, load, prologue
from rrnn_opt.emit.active_set import FIELDS, Factor, active_set_source
from rrnn_opt.solving.backends import SolverReport, solution
from rrnn_opt.solving.dense_session import DenseSession, require_mode, require_setup
from rrnn_opt.solving.parts import Array, Dense, Duals
from rrnn_opt.solving.protocol import Instance, Solution

_ENTRY = """
RRNN_EXPORT int solve(const rrnn_qp_t *qp, const real_t *J, rrnn_qp_answer_t *answer);
int solve(const rrnn_qp_t *qp, const real_t *J, rrnn_qp_answer_t *answer)
{{
    rrnn_qp_t own = *qp;
    return (int){call}(&own, J, answer);
}}
"""
SOLVED, INFEASIBLE, SPENT = 0, 1, 2
"""Answers of the C."""


@dataclass(frozen=True, eq=False)
class Raw:
    """What the C said.

    Attributes:
        status: SOLVED, INFEASIBLE or SPENT.
        x: (n,).
        duals: in qpsolvers' signs.
        steps: partial steps that were taken.
    """

    status: int
    x: Array
    duals: Duals
    steps: int


def solve_dense(problem: Dense) -> Raw:
    """Solve a dense convex QP by the dual active-set method.

    Args:
        problem: with P positive semidefinite; a singular one is solved by
            proximal rounds.

    Raises:
        CompilerError: there is no C compiler, and none has been before.

    Source:
        D. Goldfarb, A. Idnani, Mathematical Programming 27, 1983.
    """
    return _run(problem, Factor.of(problem.P))


def _run(problem: Dense, factor: Factor) -> Raw:
    n, p, m = len(problem.q), len(problem.b), len(problem.h)
    call = _compiled((n, p, m), factor.proximal)
    values = {name: np.asarray(getattr(problem, name)).ravel("F") for name in FIELDS}
    data = np.concatenate([_padded(values[name]) for name in FIELDS])
    sizes = [n, max(p, 1), max(m, 1), n]
    answer = np.zeros(sum(sizes) + 1)
    status = call(data.ctypes.data, factor.inverse.ctypes.data, answer.ctypes.data)
    x, lam, mu, box, steps = np.split(answer, np.cumsum(sizes))
    duals = Duals(y=-lam[:p], z=mu[:m], z_box=box)
    return Raw(int(status), x, duals, int(steps.view(np.uint32)[0]))


def _padded(values: Array) -> Array:
    return values.astype(np.float64) if values.size else np.zeros(1)


@lru_cache(maxsize=64)
def _compiled(
    sizes: tuple[int, int, int], proximal: float
) -> Callable[[int, int, int], int]:
    call = "rrnn_qp_solve_proximal" if proximal > 0.0 else "rrnn_qp_solve"
    parts = [prologue(), active_set_source(sizes, proximal), _ENTRY.format(call=call)]
    function: Any = load(build("\n".join(parts), name="active_set"))["solve"]
    function.argtypes = (ctypes.c_void_p,) * 3
    function.restype = ctypes.c_int
    return function  # type: ignore[no-any-return]


@checked()
@dataclass
class ActiveSet(DenseSession):
    """The controller's exact fallback as a solver.

    No active set is kept from one problem to the next.  The C is compiled
    before the clock starts, as that of a controller is; factoring counts as solving.

    Attributes:
        mode: "cold" factors the Hessian in every solve; "stream" only one that
            is not the last one.
        tolerance: KKT residual that counts as solved, in the unit of the rows.
        name: what tables call it; not for the caller to set.

    Raises:
        ArgumentError: there is no such mode.
    """

    mode: str = "cold"
    tolerance: float = 1e-6
    name: str = field(default="active_set", init=False)
    _factor: Factor | None = field(default=None, init=False, repr=False)

    def __post_init__(self) -> None:
        """Refuse an unknown mode."""
        require_mode(self.mode, "cold", "stream")

    def setup(self, instance: Instance) -> None:
        """Take the first instance; its C is compiled."""
        self._problem = None
        self.update(instance)

    def update(self, instance: Instance) -> None:
        """Take the next instance."""
        qp, last = Dense.of(instance.problem), self._problem
        self._problem = qp
        if last is None or not np.array_equal(last.P, qp.P):
            self._factor = None
            _compiled((len(qp.q), len(qp.b), len(qp.h)), Factor.of(qp.P).proximal)

    def solve(self) -> Solution:
        """Factor where the mode wants it, solve and judge.

        Raises:
            RrnnError: ``setup`` was not called.
        """
        qp = require_setup(self._problem)
        start = time.perf_counter()
        if self._factor is None or self.mode == "cold":
            self._factor = Factor.of(qp.P)
        raw = _run(qp, self._factor)
        spent = time.perf_counter() - start
        found = raw.status == SOLVED
        return solution(
            qp,
            raw.x if found else None,
            raw.duals if found else None,
            tolerance=self.tolerance,
            time_s=spent,
            report=SolverReport(iterations=raw.steps, claims=found),
        )
