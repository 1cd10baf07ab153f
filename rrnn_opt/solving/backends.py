"""Any solver that qpsolvers knows, set up anew for every problem."""

from __future__ import annotations

import time
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rrnn_opt.arguments import checked
from rrnn_opt.solving.dense_session import require_mode, require_setup
from rrnn_opt.solving.infeasible import find_farkas
from rrnn_opt.solving.parts import Array, Dense, Duals, handed
from rrnn_opt.solving.protocol import Instance, Solution
from rrnn_opt.solving.residual import NOT_JUDGED, judge, relative_residual
from rrnn_opt.solving.status import Status

TIGHT: Mapping[str, Mapping[str, Any]] = {
    # no polishing: it writes to standard output when no row is active
    "osqp": {"eps_abs": 1e-10, "eps_rel": 0.0, "max_iter": 20_000},
    "daqp": {"primal_tol": 1e-10, "dual_tol": 1e-12},
    "clarabel": {"tol_gap_abs": 1e-12, "tol_gap_rel": 1e-12, "tol_feas": 1e-12},
    "piqp": {"eps_abs": 1e-11, "eps_rel": 0.0},
    "proxqp": {"eps_abs": 1e-11, "eps_rel": 0.0},
    "quadprog": {},
    "highs": {
        "primal_feasibility_tolerance": 1e-10,
        "dual_feasibility_tolerance": 1e-10,
    },
    "scs": {"eps_abs": 1e-10, "eps_rel": 0.0, "max_iters": 20_000},
    "ecos": {"feastol": 1e-12, "abstol": 1e-12, "reltol": 1e-12},
    "cvxopt": {"feastol": 1e-12, "abstol": 1e-12, "reltol": 1e-12},
    "qpalm": {"eps_abs": 1e-10, "eps_rel": 0.0},
    "qtqp": {"tol_feas": 1e-11, "tol_gap_abs": 1e-11, "tol_gap_rel": 1e-11},
    "pyqpmad": {},
    "jaxopt_osqp": {"tol": 1e-8},
    "qpax": {"solver_tol": 1e-10},
}
"""The settings called "tight": asked-for accuracy far below every tolerance."""


@dataclass(frozen=True)
class SolverReport:
    """What a solver says of its own work.

    Attributes:
        inner_s: time spent on solving, s, or None.
        iterations: or None.
        claims: whether it says that it solved the problem, or None.
    """

    inner_s: float | None = None
    iterations: int | None = None
    claims: bool | None = None


def solution(
    problem: Dense,
    x: Any,
    duals: Duals | None,
    *,
    tolerance: float,
    time_s: float,
    report: SolverReport | None = None,
) -> Solution:
    """An answer with our judgement; a point only where the judgement gives one.

    Args:
        problem: what was solved.
        x: (n,) point of the solver, junk included, or None.
        duals: its multipliers, or None.
        tolerance: on the KKT residual.
        time_s: what it took, s.
        report: what the solver says of itself; read by nobody's verdict.
    """
    report = report or SolverReport()
    status, residual = judge(problem, x, duals, tolerance=tolerance)
    relative = relative_residual(problem, x, duals)
    point, multipliers = None, None
    if status.has_point:
        point, multipliers = np.array(x, dtype=np.float64), duals
    elif find_farkas(problem) is not None:
        status = Status.PRIMAL_INFEASIBLE
    return Solution(
        point,
        multipliers,
        status,
        residual,
        time_s,
        relative=relative,
        inner_s=report.inner_s,
        iterations=report.iterations,
        claims=report.claims,
        handed=handed(x),
    )


@checked()
@dataclass
class Qpsolvers:
    """A ``qpsolvers`` back end, set up anew for every problem.

    Attributes:
        name: e.g. "clarabel"; an unknown or absent one answers NOT_AVAILABLE.
        settings: passed on; the tight ones of that solver by default.
        tolerance: KKT residual that counts as solved.
        mode: "cold", or "warm": told its last answer as a start (``initvals``,
            which some back ends do not read).

    Raises:
        ArgumentError: there is no such mode.
    """

    name: str
    settings: Mapping[str, Any] | None = None
    tolerance: float = 1e-6
    mode: str = "cold"
    _instance: Instance | None = field(default=None, init=False, repr=False)
    _last: Array | None = field(default=None, init=False, repr=False)

    def __post_init__(self) -> None:
        """Refuse an unknown mode."""
        require_mode(self.mode, "cold", "warm")

    def setup(self, instance: Instance) -> None:
        """Take the first instance; the last answer is forgotten."""
        self._instance, self._last = instance, None

    def update(self, instance: Instance) -> None:
        """Take the next instance."""
        self._instance = instance

    def solve(self) -> Solution:
        """Call the solver, judge its answer; an exception becomes a status.

        Raises:
            RrnnError: ``setup`` was not called.
        """
        import qpsolvers

        instance = require_setup(self._instance)
        if self.name not in qpsolvers.available_solvers:
            message = f"{self.name} is not installed"
            return Solution(
                None, None, Status.NOT_AVAILABLE, NOT_JUDGED, 0.0, message=message
            )
        dense = Dense.of(instance.problem)
        start = time.perf_counter()
        try:
            answer = self._answer(instance)
        except Exception as error:
            return _failed(dense, error, time.perf_counter() - start)
        spent = time.perf_counter() - start
        found = solution(
            dense,
            answer.x,
            _duals_of(dense, answer),
            tolerance=self.tolerance,
            time_s=spent,
            report=_reported(answer),
        )
        self._last = found.x if self.mode == "warm" else None
        return found

    def _answer(self, instance: Instance) -> Any:
        """What the solver says, without its warnings; whatever it raises."""
        import qpsolvers

        settings = TIGHT.get(self.name, {}) if self.settings is None else self.settings
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return qpsolvers.solve_problem(
                instance.problem,
                solver=self.name,
                initvals=self._last,
                **settings,
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


def _reported(answer: Any) -> SolverReport:
    """What a qpsolvers solution says of time, iterations and success."""
    inner = getattr(answer, "solve_time", None)
    return SolverReport(
        inner_s=None if inner is None else float(inner),
        iterations=_iterations(answer.extras or {}),
        claims=bool(answer.found),
    )


def _iterations(extras: Mapping[str, Any]) -> int | None:
    """The count under the name that this back end gives it."""
    for name in ("iterations", "iter", "num_iterations", "steps"):
        value = extras.get(name, getattr(extras.get("info"), name, None))
        if isinstance(value, int | np.integer):
            return int(value)
        if np.ndim(value) == 1 and np.size(value):  # quadprog: steps, drops
            return int(np.sum(value))
    return None
