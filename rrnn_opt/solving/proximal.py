"""PIQP and ProxQP as sessions: one set-up, then updates of the numbers."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rrnn_opt.solving.backends import TIGHT, SolverReport, solution
from rrnn_opt.solving.dense_session import DenseSession, require_setup
from rrnn_opt.solving.parts import Array, Dense, Duals
from rrnn_opt.solving.protocol import Instance, Solution


@dataclass
class PiqpSession(DenseSession):
    """PIQP, updated in place; an interior-point method starts anew each time.

    Attributes:
        settings: PIQP's own; the tight ones by default.
        tolerance: KKT residual that counts as solved.
    """

    settings: Mapping[str, Any] = field(default_factory=lambda: TIGHT["piqp"])
    tolerance: float = 1e-6
    mode: str = field(default="stream", init=False)
    name: str = field(default="piqp", init=False)
    _solver: Any = field(default=None, init=False, repr=False)

    def setup(self, instance: Instance) -> None:
        """Give PIQP the problem."""
        import piqp

        self._problem = Dense.of(instance.problem)
        self._solver = piqp.DenseSolver()
        for name, value in self.settings.items():
            setattr(self._solver.settings, name, value)
        self._solver.setup(*_piqp_form(self._problem))

    def solve(self) -> Solution:
        """Hand over the numbers, solve, judge.

        Raises:
            RrnnError: ``setup`` was not called.
        """
        import piqp

        qp = require_setup(self._problem)
        start = time.perf_counter()
        self._solver.update(*_piqp_form(qp))
        began = time.perf_counter()
        status = self._solver.solve()
        ended = time.perf_counter()
        found = self._solver.result
        duals = Duals(
            y=np.array(found.y),
            z=np.array(found.z_u) if len(qp.h) else np.zeros(0),
            z_box=np.array(found.z_bu) - np.array(found.z_bl),
        )
        report = SolverReport(
            ended - began, int(found.info.iter), status == piqp.PIQP_SOLVED
        )
        return solution(
            qp,
            np.array(found.x),
            duals,
            tolerance=self.tolerance,
            time_s=ended - start,
            report=report,
        )


@dataclass
class ProxqpSession(DenseSession):
    """ProxQP, updated in place; it starts from its last answer.

    Attributes:
        settings: ProxQP's own; the tight ones by default.
        tolerance: KKT residual that counts as solved.
    """

    settings: Mapping[str, Any] = field(default_factory=lambda: TIGHT["proxqp"])
    tolerance: float = 1e-6
    mode: str = field(default="stream", init=False)
    name: str = field(default="proxqp", init=False)
    _solver: Any = field(default=None, init=False, repr=False)

    def setup(self, instance: Instance) -> None:
        """Give ProxQP the problem."""
        from proxsuite import proxqp

        qp = self._problem = Dense.of(instance.problem)
        self._solver = proxqp.dense.QP(len(qp.q), len(qp.b), len(qp.h), True)
        for name, value in self.settings.items():
            setattr(self._solver.settings, name, value)
        last = proxqp.InitialGuess.WARM_START_WITH_PREVIOUS_RESULT
        self._solver.settings.initial_guess = last
        self._solver.init(*_proxqp_form(qp))

    def solve(self) -> Solution:
        """Hand over the numbers, solve, judge.

        Raises:
            RrnnError: ``setup`` was not called.
        """
        from proxsuite import proxqp

        qp = require_setup(self._problem)
        start = time.perf_counter()
        self._solver.update(*_proxqp_form(qp))
        began = time.perf_counter()
        self._solver.solve()
        ended = time.perf_counter()
        found = self._solver.results
        z, box = np.split(np.array(found.z, dtype=np.float64), [len(qp.h)])
        claims = found.info.status == proxqp.QPSolverOutput.PROXQP_SOLVED
        return solution(
            qp,
            np.array(found.x),
            Duals(y=np.array(found.y), z=z, z_box=box),
            tolerance=self.tolerance,
            time_s=ended - start,
            report=SolverReport(ended - began, int(found.info.iter), bool(claims)),
        )


def _piqp_form(qp: Dense) -> tuple[Array | None, ...]:
    """P, c, A, b, G, h_l, h_u, x_l, x_u, column by column."""
    column = np.asfortranarray
    P, A, G = column(qp.P), column(qp.A), column(qp.G)
    return P, qp.q, A, qp.b, G, None, qp.h, qp.lb, qp.ub


def _proxqp_form(qp: Dense) -> tuple[Array, ...]:
    """H, g, A, b, C, l, u, l_box, u_box."""
    below, big = np.full(len(qp.h), -1e20), 1e20
    box = np.clip(qp.lb, -big, big), np.clip(qp.ub, -big, big)
    return qp.P, qp.q, qp.A, qp.b, qp.G, below, qp.h, *box
