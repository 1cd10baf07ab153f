"""CasADi's QP plugins as solvers: what a CasADi user gets without another package."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from rrnn_opt.solving.backends import SolverReport, solution
from rrnn_opt.solving.dense_session import DenseSession, require_mode, require_setup
from rrnn_opt.solving.parts import Array, Dense, Duals
from rrnn_opt.solving.protocol import Instance, Solution

_QUIET = {"print_iter": False, "print_header": False, "print_info": False}

PLUGINS: Mapping[str, Mapping[str, Any]] = {
    "osqp": {
        "osqp": {"verbose": False, "eps_abs": 1e-10, "eps_rel": 0, "max_iter": 20_000}
    },
    "qpoases": {"printLevel": "none"},
    "qrqp": _QUIET,
    "proxqp": {"proxqp": {"eps_abs": 1e-11, "eps_rel": 0.0, "verbose": False}},
    "highs": {"highs": {"output_flag": False}},
    "daqp": {},
    "piqp": {"piqp": {"eps_abs": 1e-11, "eps_rel": 0.0, "verbose": False}},
}
"""Plugins of CasADi's wheel that solve a dense QP, with their tight settings."""


@dataclass
class CasadiConic(DenseSession):
    """``casadi.conic`` with one of its plugins.

    Attributes:
        plugin: one of ``PLUGINS``.
        mode: "stream": made once, then started from its last answer; "cold": made
            anew for every problem.
        tolerance: KKT residual that counts as solved.

    Raises:
        ArgumentError: there is no such mode.
    """

    plugin: str
    mode: str = "stream"
    tolerance: float = 1e-6
    _call: Any = field(default=None, init=False, repr=False)
    _start: dict[str, Any] = field(default_factory=dict, init=False, repr=False)

    def __post_init__(self) -> None:
        """Refuse an unknown mode."""
        require_mode(self.mode, "stream", "cold")

    @property
    def name(self) -> str:
        """E.g. "casadi-osqp"."""
        return f"casadi-{self.plugin}"

    def setup(self, instance: Instance) -> None:
        """Take the first instance; make the function when streaming."""
        self._problem, self._start = Dense.of(instance.problem), {}
        self._call = _made(self.plugin, self._problem)

    def solve(self) -> Solution:
        """Call the plugin, judge its answer; an exception becomes a status.

        Raises:
            RrnnError: ``setup`` was not called.
        """
        qp = require_setup(self._problem)
        start = time.perf_counter()
        if self.mode == "cold":
            self._call, self._start = _made(self.plugin, qp), {}
        x, duals, claims = None, None, False
        try:
            answer = self._call(**_numbers(qp), **self._start)
            claims = bool(self._call.stats()["success"])
            x, duals = _read(qp, answer)
            self._start = _next_start(answer) if claims else {}
        except RuntimeError:
            self._start = {}
        spent = time.perf_counter() - start
        report = SolverReport(*_counted(self._call), claims)
        return solution(
            qp, x, duals, tolerance=self.tolerance, time_s=spent, report=report
        )


def _made(plugin: str, qp: Dense) -> Any:
    import casadi as ca

    n, rows = len(qp.q), len(qp.h) + len(qp.b)
    shapes = {"h": ca.Sparsity.dense(n, n), "a": ca.Sparsity.dense(rows, n)}
    options = {**PLUGINS[plugin], "error_on_fail": False, "record_time": True}
    return ca.conic("qp", plugin, shapes, options)


def _numbers(qp: Dense) -> dict[str, Array]:
    below = np.full(len(qp.h), -np.inf)
    return {
        "h": qp.P,
        "g": qp.q,
        "a": np.vstack([qp.G, qp.A]),
        "lba": np.concatenate([below, qp.b]),
        "uba": np.concatenate([qp.h, qp.b]),
        "lbx": qp.lb,
        "ubx": qp.ub,
    }


def _read(qp: Dense, answer: Mapping[str, Any]) -> tuple[Array, Duals]:
    """Point and multipliers; CasADi's are of the cost plus lam'(rows)."""
    x, rows, box = (
        np.asarray(answer[name], dtype=np.float64).ravel()
        for name in ("x", "lam_a", "lam_x")
    )
    z, y = np.split(rows, [len(qp.h)])
    return x, Duals(y=y, z=z, z_box=box)


def _next_start(answer: Mapping[str, Any]) -> dict[str, Any]:
    names = {"x0": "x", "lam_x0": "lam_x", "lam_a0": "lam_a"}
    return {start: answer[name] for start, name in names.items()}


def _counted(call: Any) -> tuple[float | None, int | None]:
    """Time of the solver alone, and iterations; 0 and -1 mean that it is silent."""
    stats = call.stats()
    seconds, count = stats.get("t_wall_solver", 0.0), stats.get("iter_count", -1)
    return (float(seconds) or None), (int(count) if 0 <= count < 10**6 else None)
