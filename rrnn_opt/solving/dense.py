"""One network for all dense convex QPs of a size, their data its parameters."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import casadi as ca
import numpy as np
from numpy.typing import ArrayLike

from rrnn_opt.dynamics import NeuralDynamics
from rrnn_opt.errors import RrnnError, ShapeError
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks import PrimalDual
from rrnn_opt.solving.infeasible import find_farkas
from rrnn_opt.solving.parts import Array, Dense, Duals
from rrnn_opt.solving.residual import Residual, judge
from rrnn_opt.solving.scaling import Scaled
from rrnn_opt.solving.settle import settle_at
from rrnn_opt.solving.status import Status
from rrnn_opt.symbolic import Symbol

LARGEST = 40_000
"""Products in one step of the network that are still written out as C."""

EPSILON = 0.01
"""Time constant of the network, s."""

_ROUNDS = 12
"""Runs in all: each draws the proximal term nearer and stops later."""


@dataclass(frozen=True, eq=False)
class Answer:
    """Where the network came to rest, judged on the programme as given.

    Attributes:
        status: our judgement.
        residual: what it rests on.
        x: (n,), worth something only where the status has a point.
        duals: in qpsolvers' signs, likewise.
        steps: Euler steps in all.
        newton: Newton steps that finished it, in all.
    """

    status: Status
    residual: Residual
    x: Array
    duals: Duals
    steps: int
    newton: int


def settle_dense(
    problem: Dense,
    *,
    initvals: ArrayLike | None = None,
    tolerance: float = 1e-6,
    max_steps: int = 200_000,
) -> Answer:
    """Settle the network of a dense programme; run on while its judgement asks.

    Where P is nearly singular this is the proximal point method: ``rho I`` is
    added to P, and the cost is drawn to the last answer.

    Args:
        problem: with P positive semidefinite.
        initvals: x to start from, (n,), or None.
        tolerance: on the absolute KKT residual of ``problem``.
        max_steps: Euler steps of each run.

    Raises:
        NotAQpError: P is not positive semidefinite.
        NotFiniteError: a coefficient is NaN or infinite, a bound is NaN.
        ShapeError: initvals has the wrong size.
        RrnnError: the programme is too large to be written out.
    """
    scaled = Scaled.of(problem)
    dynamics = dense_network(*scaled.sizes)
    state = _start(scaled, initvals, dynamics.state.size)
    n, stop, steps, newton = scaled.sizes[0], 0.01 * tolerance, 0, 0
    step = EPSILON / (2.0 * max(scaled.sigma**2, 0.5))
    for _ in range(_ROUNDS):
        values = {**scaled.values, "cost": scaled.cost_near(state[:n])}
        _, info = settle_at(
            dynamics,
            values,
            tolerance=stop,
            max_steps=max_steps,
            step=step,
            start=state,
        )
        state, stop = info.state, max(0.1 * stop, 1e-13)
        steps, newton = steps + info.steps, newton + info.newton
        answer = _judged(scaled, state, (steps, newton), tolerance)
        if answer.status is Status.SOLVED or not info.status.has_point:
            break
    if answer.status.has_point or find_farkas(problem) is None:
        return answer
    return replace(answer, status=Status.PRIMAL_INFEASIBLE)


@lru_cache(maxsize=32)
def dense_network(n: int, p: int, m: int) -> NeuralDynamics:
    """``PrimalDual`` on ``min 1/2 v'v + cost'v, A v = b, G v <= h``.

    Args:
        n: size of v.
        p: equality rows.
        m: inequality rows.

    Raises:
        RrnnError: the step would be more than ``LARGEST`` products.
    """
    if 2 * n * (p + m) > LARGEST:
        raise RrnnError(
            f"a dense network of {n} unknowns and {p + m} rows is too large to be "
            f"written out; twice their product must not exceed {LARGEST}"
        )
    v = Symbol.vector("v", n, "1", "scaled unknown")
    cost = Symbol.vector("cost", n, "1", "linear cost")
    A, b, slack = _rows(v, p, "A", "b")
    G, h, rest = _rows(v, m, "G", "h")
    form = Formulation(
        name="dense_qp",
        decision=v,
        parameters=(cost, *(s for s in (A, b, G, h) if s is not None)),
        cost=ca.dot(v.sx, v.sx) / 2 + ca.dot(cost.sx, v.sx),
        equalities=slack,
        inequalities=None if rest is None else -rest,
    )
    return PrimalDual(epsilon=EPSILON)(form)


def _rows(
    v: Symbol, count: int, matrix: str, side: str
) -> tuple[Symbol | None, Symbol | None, ca.SX | None]:
    """Symbols of ``matrix v`` against ``side``, and ``side - matrix v``."""
    if count == 0:
        return None, None, None
    rows = Symbol.matrix(matrix, (count, v.size), "1", f"rows {matrix}")
    right = Symbol.vector(side, count, "1", f"right-hand sides of the rows {matrix}")
    return rows, right, right.sx - rows.sx @ v.sx


def _start(scaled: Scaled, initvals: ArrayLike | None, size: int) -> Array:
    state = np.zeros(size)
    if initvals is not None:
        x = np.asarray(initvals, dtype=np.float64)
        n = scaled.sizes[0]
        if x.shape != (n,):
            raise ShapeError("initvals", (n,), x.shape)
        state[:n] = np.linalg.solve(scaled.back, x)
    return state


def _judged(
    scaled: Scaled, state: Array, counts: tuple[int, int], tolerance: float
) -> Answer:
    x, duals = scaled.given(state)
    status, residual = judge(scaled.problem, x, duals, tolerance=tolerance)
    if not status.has_point:
        status = Status.MAX_ITER
    return Answer(status, residual, x, duals, *counts)
