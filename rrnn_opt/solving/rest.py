"""Runs of a network to rest, each judged, with smaller steps where one fails."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from rrnn_opt.solving.infeasible import find_farkas
from rrnn_opt.solving.network import ESCAPE, RestableNetwork
from rrnn_opt.solving.parts import Array, Dense, Duals
from rrnn_opt.solving.residual import NOT_JUDGED, Residual, judge
from rrnn_opt.solving.status import Status

_REFINEMENTS = 4
"""How often the stopping residual is lowered when the KKT residual asks for it."""

_BURST = 4000
"""Euler steps before the first Newton finish; most programmes need fewer."""

_LONGER = 4
"""Each burst is so many times as long as the last."""

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
    newton: int = 0
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
    newton: bool = True

    def rest(self, state: Array, h: float) -> Attempt:
        """Bursts of Euler steps, each longer, with a Newton finish after each.

        A programme that does not settle in the first burst is asked for a
        certificate of infeasibility before more is spent on it.
        """
        attempt = Attempt(state, 0, h, Status.MAX_ITER)
        burst = _BURST if self.newton else self.max_steps
        while True:
            first = attempt.steps == 0
            limit = min(attempt.steps + burst, self.max_steps)
            attempt = self._settled(attempt, limit)
            if attempt.status in (Status.SOLVED, Status.NUMERICAL):
                return attempt
            finished = self._finished(attempt) if self.newton else attempt
            if finished.status.has_point:
                return finished
            if first and find_farkas(self.problem) is not None:
                return replace(attempt, status=Status.PRIMAL_INFEASIBLE)
            if attempt.steps < limit or limit >= self.max_steps:
                return attempt
            burst *= _LONGER

    def insist(self, first: Array, h: float) -> Attempt:
        """Settle; after a failure with smaller steps, unless no point is feasible."""
        best = self.rest(first, h)
        for _ in range(_ATTEMPTS - 1):
            if best.status.has_point or best.status is Status.PRIMAL_INFEASIBLE:
                break
            if not self.network.steppable:
                break
            h *= _SHRINK
            attempt = self.rest(first, h)
            if attempt.residual.worst <= best.residual.worst:
                best = attempt
        return best

    def _settled(self, begin: Attempt, limit: int) -> Attempt:
        """Settle, judge, and settle further while the judgement asks for it."""
        state, steps, h, stop = begin.state, begin.steps, begin.step, self.tolerance
        for _ in range(_REFINEMENTS):
            run = self.network.run(
                state, self.values, step=h, tolerance=stop, max_steps=limit - steps
            )
            state, steps = run.state, steps + run.steps
            if not run.residual <= ESCAPE:
                return Attempt(state, steps, h, Status.NUMERICAL)
            attempt = self._judged(state, steps, h)
            if attempt.status is Status.SOLVED or run.residual > stop:
                break
            stop *= 0.1
        return attempt

    def _finished(self, attempt: Attempt) -> Attempt:
        """The equilibrium by Newton's method from where the network stands."""
        run = self.network.newton(
            attempt.state, self.values, tolerance=1e-3 * self.tolerance
        )
        if not run.residual <= self.tolerance:
            return attempt
        judged = self._judged(run.state, attempt.steps, attempt.step)
        return replace(judged, newton=run.steps)

    def _judged(self, state: Array, steps: int, h: float) -> Attempt:
        read = self.network.read(state, self.values)
        duals = _named_duals(read, self.problem)
        signed = Duals(-duals["equality"], duals["inequality"], duals["box"])
        status, residual = judge(
            self.problem, read["output"], signed, tolerance=self.tolerance
        )
        if not status.has_point:
            status = Status.MAX_ITER
            return Attempt(state, steps, h, status, residual=residual)
        x = read["output"]
        return Attempt(state, steps, h, status, residual=residual, x=x, duals=duals)


def _named_duals(read: Mapping[str, Array], problem: Dense) -> dict[str, Array]:
    return {
        "equality": read.get("lam", np.zeros(len(problem.b))),
        "inequality": read.get("mu", np.zeros(len(problem.h))),
        "box": read.get("z_box", np.zeros(len(problem.q))),
    }
