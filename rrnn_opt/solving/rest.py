"""Runs of a network to rest, each judged, with smaller steps where one fails."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from rrnn_opt.solving.infeasible import find_farkas
from rrnn_opt.solving.network import ESCAPE, RestableNetwork
from rrnn_opt.solving.residual import NOT_JUDGED, Array, Dense, Duals, Residual, judge
from rrnn_opt.solving.status import Status

_REFINEMENTS = 4
"""How often the stopping residual is lowered when the KKT residual asks for it."""

_SHRINK = 0.25
"""A step that diverges is multiplied by this."""

_ATTEMPTS = 4


@dataclass(frozen=True, eq=False)
class Attempt:
    """One run to rest and what our judgement says of it."""

    state: Array
    steps: int
    step: float
    status: Status
    residual: Residual = NOT_JUDGED
    x: Array | None = None
    duals: dict[str, Array] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Job:
    """A network, the numbers of one programme, and when to stop."""

    network: RestableNetwork
    problem: Dense
    values: Sequence[Array]
    tolerance: float
    max_steps: int

    def rest(self, state: Array, h: float) -> Attempt:
        """Settle, judge, and settle further while the judgement asks for it."""
        steps, stop = 0, self.tolerance
        for _ in range(_REFINEMENTS):
            left = self.max_steps - steps
            run = self.network.run(
                state, self.values, step=h, tolerance=stop, max_steps=left
            )
            state, steps = run.state, steps + run.steps
            if not run.residual <= ESCAPE:
                return Attempt(state, steps, h, Status.NUMERICAL)
            attempt = self._judged(state, steps, h)
            if attempt.status is Status.SOLVED or run.residual > stop:
                break
            stop *= 0.1
        return attempt

    def insist(self, first: Array, failed: Attempt) -> Attempt:
        """After a failure: is the programme infeasible?  Else smaller steps."""
        if find_farkas(self.problem) is not None:
            return replace(failed, status=Status.PRIMAL_INFEASIBLE)
        best, h = failed, failed.step
        for _ in range(_ATTEMPTS - 1):
            h *= _SHRINK
            attempt = self.rest(first, h)
            if attempt.residual.worst <= best.residual.worst:
                best = attempt
            if best.status.has_point:
                break
        return best

    def _judged(self, state: Array, steps: int, h: float) -> Attempt:
        read = self.network.read(state, self.values)
        duals = _named_duals(read, self.problem)
        signed = Duals(-duals["equality"], duals["inequality"], duals["box"])
        status, residual = judge(
            self.problem, read["output"], signed, tolerance=self.tolerance
        )
        if not status.has_point:
            return Attempt(state, steps, h, Status.MAX_ITER, residual)
        return Attempt(state, steps, h, status, residual, read["output"], duals)


def _named_duals(read: Mapping[str, Array], problem: Dense) -> dict[str, Array]:
    return {
        "equality": read.get("lam", np.zeros(len(problem.b))),
        "inequality": read.get("mu", np.zeros(len(problem.h))),
        "box": read.get("z_box", np.zeros(len(problem.q))),
    }
