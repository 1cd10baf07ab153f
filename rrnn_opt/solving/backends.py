"""Any solver that qpsolvers knows, set up anew for every problem."""

from __future__ import annotations

import time
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rrnn_opt.solving.infeasible import find_farkas
from rrnn_opt.solving.protocol import Instance, Solution
from rrnn_opt.solving.residual import NOT_JUDGED, Array, Dense, Duals, judge
from rrnn_opt.solving.status import Status

TIGHT: Mapping[str, Mapping[str, Any]] = {
    # no polishing: it writes to standard output when no row is active
    "osqp": {"eps_abs": 1e-10, "eps_rel": 0.0, "max_iter": 20_000},
    "daqp": {"primal_tol": 1e-10, "dual_tol": 1e-12},
    "clarabel": {"tol_gap_abs": 1e-12, "tol_gap_rel": 1e-12, "tol_feas": 1e-12},
    "piqp": {"eps_abs": 1e-11, "eps_rel": 0.0},
    "proxqp": {"eps_abs": 1e-11, "eps_rel": 0.0},
    "quadprog": {},
}
"""The settings called "tight": asked-for accuracy far below every tolerance."""


def solution(
    problem: Dense, x: Any, duals: Duals | None, *, tolerance: float, time_s: float
) -> Solution:
    """An answer with our judgement; a point only where the judgement gives one.

    Args:
        problem: what was solved.
        x: (n,) point of the solver, junk included, or None.
        duals: its multipliers, or None.
        tolerance: on the KKT residual.
        time_s: what it took, s.
    """
    status, residual = judge(problem, x, duals, tolerance=tolerance)
    if status.has_point:
        point = np.array(x, dtype=np.float64)
        return Solution(point, duals, status, residual, time_s)
    if find_farkas(problem) is not None:
        status = Status.PRIMAL_INFEASIBLE
    return Solution(None, None, status, residual, time_s)


@dataclass
class Qpsolvers:
    """A ``qpsolvers`` back end; every solve is a cold one.

    Attributes:
        name: e.g. "clarabel"; an unknown or absent one answers NOT_AVAILABLE.
        settings: passed on; the tight ones of that solver by default.
        tolerance: KKT residual that counts as solved.
    """

    name: str
    settings: Mapping[str, Any] | None = None
    tolerance: float = 1e-6
    mode: str = field(default="cold", init=False)
    _instance: Instance | None = field(default=None, init=False, repr=False)

    def setup(self, instance: Instance) -> None:
        """Take the first instance."""
        self._instance = instance

    def update(self, instance: Instance) -> None:
        """Take the next instance."""
        self._instance = instance

    def solve(self) -> Solution:
        """Call the solver, judge its answer; an exception becomes a status."""
        import qpsolvers

        if self._instance is None:
            raise ValueError("setup comes before solve")
        if self.name not in qpsolvers.available_solvers:
            message = f"{self.name} is not installed"
            return Solution(
                None, None, Status.NOT_AVAILABLE, NOT_JUDGED, 0.0, message=message
            )
        settings = TIGHT.get(self.name, {}) if self.settings is None else self.settings
        dense = Dense.of(self._instance.problem)
        start = time.perf_counter()
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                answer = qpsolvers.solve_problem(
                    self._instance.problem, solver=self.name, **settings
                )
        except Exception as error:
            spent = time.perf_counter() - start
            return _failed(dense, error, spent)
        spent = time.perf_counter() - start
        return solution(
            dense,
            answer.x,
            _duals_of(dense, answer),
            tolerance=self.tolerance,
            time_s=spent,
        )


def _failed(problem: Dense, error: Exception, time_s: float) -> Solution:
    """A solver that raised: infeasible if we can prove it, an error if not."""
    infeasible = find_farkas(problem) is not None
    status = Status.PRIMAL_INFEASIBLE if infeasible else Status.ERROR
    message = f"{type(error).__name__}: {error}"
    return Solution(None, None, status, NOT_JUDGED, time_s, message=message)


def _duals_of(qp: Dense, answer: Any) -> Duals | None:
    """The multipliers of a qpsolvers solution, absent parts as zeros."""

    def part(value: Any, size: int) -> Array:
        if size == 0 or value is None or np.size(value) == 0:
            return np.zeros(size)
        return np.asarray(value, dtype=np.float64).ravel()

    if answer.x is None:
        return None
    return Duals(
        y=part(answer.y, len(qp.b)),
        z=part(answer.z, len(qp.h)),
        z_box=part(answer.z_box, len(qp.q)),
    )
