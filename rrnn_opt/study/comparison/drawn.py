"""Drawn QPs: strictly convex, degenerate, badly scaled, infeasible, and large.

Each is made around a known optimum: x, the active rows and multipliers are drawn
first, then q and the right-hand sides follow from the KKT conditions.  So the truth
is known without any solver.  (No package on PyPI carries the Maros-Meszaros
problems themselves; "dense" is of the size of its dense half, not of its kind.)
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from rrnn_opt.solving import Instance
from rrnn_opt.solving.parts import Array
from rrnn_opt.study.comparison.problem_set import (
    INFEASIBLE,
    SOLVABLE,
    ProblemSet,
)

Rng = np.random.Generator
Draw = Callable[[Rng, int], Instance]


def convex(rng: Rng, k: int) -> Instance:
    """Strictly convex: 5 to 30 unknowns, rows and bounds, half of them active."""
    n = int(rng.integers(5, 31))
    return _around_optimum(rng, n, n // 4, n // 2, _hessian(rng, n, 1e2))


def degenerate(rng: Rng, k: int) -> Instance:
    """Repeated rows, more active rows than unknowns, a singular Hessian."""
    n = int(rng.integers(5, 16))
    root = rng.normal(size=(max(1, n // 2), n))
    flat = root.T @ root
    return _around_optimum(rng, n, 1, n, flat, repeat=True, active=1.0)


def scaled(rng: Rng, k: int) -> Instance:
    """Unknowns and rows in units from 1e-4 to 1e4, as when rad meets mm."""
    n = int(rng.integers(5, 21))
    given = _around_optimum(rng, n, 2, n // 2, _hessian(rng, n, 1e3)).problem
    unit, rows = 10.0 ** rng.uniform(-4, 4, n), 10.0 ** rng.uniform(-3, 3, n // 2)
    return _problem(
        given.P * np.outer(unit, unit),
        given.q * unit,
        given.G * np.outer(rows, unit),
        given.h * rows,
        given.A * unit,
        given.b,
        given.lb / unit,
        given.ub / unit,
    )


def dense(rng: Rng, k: int) -> Instance:
    """100 to 300 unknowns, as many rows, dense, condition 1e4."""
    n = int(rng.integers(100, 301))
    return _around_optimum(rng, n, n // 10, n, _hessian(rng, n, 1e4))


def infeasible(rng: Rng, k: int) -> Instance:
    """A convex one to which two rows are added that contradict each other by 0.1."""
    given = convex(rng, k).problem
    row = rng.normal(size=given.q.size)
    row /= np.linalg.norm(row)
    level = float(rng.normal())
    return _problem(
        given.P,
        given.q,
        np.vstack([given.G, row, -row]),
        np.concatenate([given.h, [level - 0.05, -level - 0.05]]),
        given.A,
        given.b,
        given.lb,
        given.ub,
    )


DRAWS: dict[str, tuple[Draw, int]] = {
    "convex": (convex, 40),
    "degenerate": (degenerate, 40),
    "scaled": (scaled, 40),
    "dense": (dense, 6),
    "contradictory": (infeasible, 40),
}
"""Draws by the name of their set, and how many are made."""


def drawn_set(name: str, *, seed: int = 0) -> ProblemSet:
    """A set of ``DRAWS``; problem k follows from name, seed and k alone.

    Args:
        name: of the set.
        seed: of the draws.
    """
    draw, count = DRAWS[name]
    key = [seed, *name.encode()]
    made = tuple(draw(np.random.default_rng([*key, k]), k) for k in range(count))
    truth = INFEASIBLE if name == "contradictory" else SOLVABLE
    about = " ".join((draw.__doc__ or "").split())
    return ProblemSet(name, made, (truth,) * count, False, about)


def _around_optimum(
    rng: Rng,
    n: int,
    meq: int,
    mineq: int,
    P: Array,
    *,
    repeat: bool = False,
    active: float = 0.5,
) -> Instance:
    x, y = rng.uniform(-1.0, 1.0, n), rng.normal(size=meq)
    G, A = rng.normal(size=(mineq, n)), rng.normal(size=(meq, n))
    if repeat:
        G[1::2] = G[: mineq - 1 : 2] * rng.uniform(0.5, 2.0, (mineq // 2, 1))
    on = rng.random(mineq) < active
    z = np.where(on & (rng.random(mineq) < 0.7), rng.exponential(size=mineq), 0.0)
    h = G @ x + np.where(on, 0.0, rng.exponential(size=mineq))
    side = rng.integers(-1, 2, n) * (rng.random(n) < 0.5)
    lb = np.where(side < 0, x, x - rng.exponential(size=n) - 0.1)
    ub = np.where(side > 0, x, x + rng.exponential(size=n) + 0.1)
    q = -(P @ x + A.T @ y + G.T @ z + side * rng.exponential(size=n))
    return _problem(P, q, G, h, A, A @ x, lb, ub)


def _hessian(rng: Rng, n: int, condition: float) -> Array:
    """A random positive definite matrix of that condition number."""
    basis, _ = np.linalg.qr(rng.normal(size=(n, n)))
    values = np.geomspace(1.0, condition, n) / np.sqrt(condition)
    P = basis @ np.diag(values) @ basis.T
    return np.asarray(0.5 * (P + P.T), dtype=np.float64)


def _problem(*parts: Array) -> Instance:
    from qpsolvers import Problem

    P, q, G, h, A, b, lb, ub = (np.ascontiguousarray(part) for part in parts)
    return Instance(Problem(P, q, G, h, A, b, lb, ub))
