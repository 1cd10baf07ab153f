"""OSQP and DAQP as sessions: one set-up, then updates of the numbers.

Both take rows with two sides; we stack bounds, inequalities and equalities
as  [lb; -inf; b] <= [I; G; A] x <= [ub; h; b].
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.arguments import checked
from rrnn_opt.solving.backends import TIGHT, SolverReport, solution
from rrnn_opt.solving.dense_session import DenseSession, require_mode, require_setup
from rrnn_opt.solving.parts import Array, Dense, Duals
from rrnn_opt.solving.protocol import Instance, Solution

_EQUALITY = 5
"""DAQP's word for a row that is always active and cannot be dropped."""


def _sides(qp: Dense) -> tuple[Array, Array]:
    """Lower and upper sides of bounds, inequalities and equalities, in order."""
    lower = np.concatenate([qp.lb, np.full(len(qp.h), -np.inf), qp.b])
    return lower, np.concatenate([qp.ub, qp.h, qp.b])


def _split(qp: Dense, multipliers: Array) -> Duals:
    """Multipliers of the stacked rows by kind."""
    n, mineq = len(qp.q), len(qp.h)
    box, z, y = np.split(np.asarray(multipliers, dtype=np.float64), [n, n + mineq])
    return Duals(y=y[: len(qp.b)], z=z, z_box=box)


@checked()
@dataclass
class OsqpSession(DenseSession):
    """OSQP, updated in place; it starts from its last answer when warm.

    Attributes:
        mode: "warm", or "cold": the last answer is forgotten before each solve.
        settings: OSQP's own; the tight ones by default.
        tolerance: KKT residual that counts as solved, in the unit of the rows.
        name: what tables call it; not for the caller to set.

    Raises:
        ArgumentError: there is no such mode.
    """

    mode: str = "warm"
    settings: Mapping[str, Any] = field(default_factory=lambda: TIGHT["osqp"])
    tolerance: float = 1e-6
    name: str = field(default="osqp", init=False)
    _solver: Any = field(default=None, init=False, repr=False)

    def __post_init__(self) -> None:
        """Refuse an unknown mode."""
        require_mode(self.mode, "warm", "cold")

    def setup(self, instance: Instance) -> None:
        """Give OSQP the problem, every entry of the matrices kept."""
        import osqp

        qp = Dense.of(instance.problem)
        lower, upper = _sides(qp)
        self._solver = osqp.OSQP()
        self._solver.setup(
            P=_upper_csc(qp.P),
            q=qp.q,
            A=_rows_csc(qp),
            l=lower,
            u=upper,
            verbose=False,
            warm_starting=self.mode == "warm",
            **self.settings,
        )
        self._problem = qp

    def solve(self) -> Solution:
        """Hand over the numbers, solve, judge.

        Raises:
            RrnnError: ``setup`` was not called.
        """
        qp = require_setup(self._problem)
        start = time.perf_counter()
        lower, upper = _sides(qp)
        self._solver.update(
            q=qp.q,
            l=lower,
            u=upper,
            Px=qp.P.T[np.tril_indices(len(qp.q))],
            Ax=_row_values(qp),
        )
        answer = self._solver.solve(raise_error=False)
        spent = time.perf_counter() - start
        return solution(
            qp,
            answer.x,
            None if answer.y is None else _split(qp, answer.y),
            tolerance=self.tolerance,
            time_s=spent,
            report=_reported_by_osqp(answer.info),
        )


@checked()
@dataclass
class DaqpSession(DenseSession):
    """DAQP, updated in place: a dense active-set method, exact in few steps.

    Attributes:
        mode: "warm" keeps the last active set; "cold" sets up anew each time.
        settings: DAQP's own; the tight ones by default.
        tolerance: KKT residual that counts as solved, in the unit of the rows.
        name: what tables call it; not for the caller to set.

    Raises:
        ArgumentError: there is no such mode.
    """

    mode: str = "warm"
    settings: Mapping[str, Any] = field(default_factory=lambda: TIGHT["daqp"])
    tolerance: float = 1e-6
    name: str = field(default="daqp", init=False)
    _model: Any = field(default=None, init=False, repr=False)
    _fresh: bool = field(default=False, init=False, repr=False)

    def __post_init__(self) -> None:
        """Refuse an unknown mode."""
        require_mode(self.mode, "warm", "cold")

    def setup(self, instance: Instance) -> None:
        """Give DAQP the problem."""
        self._problem = Dense.of(instance.problem)
        self._set_up(self._problem)
        self._fresh = True

    def update(self, instance: Instance) -> None:
        """Take the next numbers; they are handed over in ``solve``."""
        super().update(instance)
        self._fresh = False

    def solve(self) -> Solution:
        """Hand over the numbers, solve, judge.

        Raises:
            RrnnError: ``setup`` was not called.
        """
        qp = require_setup(self._problem)
        start = time.perf_counter()
        if self.mode == "cold":
            self._set_up(qp)
        elif not self._fresh:
            H, f, rows, upper, lower, _ = _daqp_form(qp)
            self._model.update(H=H, f=f, A=rows, bupper=upper, blower=lower)
        self._fresh = False
        x, _, flag, info = self._model.solve()
        spent = time.perf_counter() - start
        found = flag > 0
        return solution(
            qp,
            x if found else None,
            _split(qp, info["lam"]) if found else None,
            tolerance=self.tolerance,
            time_s=spent,
            report=SolverReport(info.get("solve_time"), info.get("iterations"), found),
        )

    def _set_up(self, qp: Dense) -> None:
        import daqp

        self._model = daqp.Model()
        self._model.settings = dict(self.settings)
        self._model.setup(*_daqp_form(qp))


def _reported_by_osqp(info: Any) -> SolverReport:
    return SolverReport(info.solve_time, info.iter, info.status == "solved")


def _daqp_form(
    qp: Dense,
) -> tuple[Array, Array, Array, Array, Array, NDArray[np.int32]]:
    """H, f, rows, upper, lower and sense, as DAQP wants them."""
    lower, upper = _sides(qp)
    sense = np.zeros(len(upper), dtype=np.int32)
    sense[len(upper) - len(qp.b) :] = _EQUALITY
    rows, big = np.ascontiguousarray(np.vstack([qp.G, qp.A])), 1e30
    if len(rows) == 0:  # DAQP reads beyond an empty matrix: a row that asks nothing
        rows, sense = np.zeros((1, len(qp.q))), np.append(sense, np.int32(0))
        lower, upper = np.append(lower, -big), np.append(upper, big)
    return (
        np.ascontiguousarray(qp.P),
        np.ascontiguousarray(qp.q),
        rows,
        np.minimum(upper, big),
        np.maximum(lower, -big),
        sense,
    )


def _row_values(qp: Dense) -> Array:
    """Stored entries of [I; G; A], column by column: a one, then G's, then A's."""
    ones = np.ones((1, len(qp.q)))
    return np.vstack([ones, qp.G, qp.A]).ravel(order="F")


def _rows_csc(qp: Dense) -> Any:
    """[I; G; A] with all entries of G and A stored, so that updates fit."""
    from scipy import sparse

    n, rows = len(qp.q), len(qp.h) + len(qp.b)
    below = np.tile(np.arange(n, n + rows), (n, 1))
    indices = np.hstack([np.arange(n)[:, None], below]).ravel()
    starts = np.arange(n + 1) * (1 + rows)
    return sparse.csc_matrix((_row_values(qp), indices, starts), shape=(n + rows, n))


def _upper_csc(matrix: Array) -> Any:
    """The upper triangle, zeros stored too."""
    from scipy import sparse

    n = len(matrix)
    indices = np.concatenate([np.arange(c + 1) for c in range(n)])
    starts = np.concatenate([[0], np.cumsum(np.arange(1, n + 1))])
    values = matrix.T[np.tril_indices(n)]
    return sparse.csc_matrix((values, indices, starts), shape=(n, n))
