"""One programme, several answers: how far apart, and who is right.

Where the active rows fix the point well, the optimum is computed once more, by
one linear solve on the rows that the best answer holds active; it is the truth
when its own KKT residual is at rounding level.  Where that solve gives no
optimum (dependent rows: some multiplier comes out with the wrong sign) the
best answer itself is the truth, under the same condition.  An answer within
the tolerance of the truth is right.  Elsewhere an answer is right when its KKT
residual is within the tolerance, and several different ones may be.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.solving.parts import Array, Dense, Duals
from rrnn_opt.solving.residual import kkt_residual

Mask = NDArray[np.bool_]

TOLERANCE = 1e-6
"""What counts as the same: in x absolutely, in multipliers against 1 + the largest."""

CONDITION = 1e3
"""Largest condition number of the active rows of a well-conditioned point."""

CURVATURE = 1e-6
"""Least curvature along the active rows' kernel, relative to P's largest."""

EXACT = 1e-9
"""KKT residual, against 1 + the largest multiplier, of what counts as the truth."""

_RANK = 1e-12
_ACTIVE = 1e-7


@dataclass(frozen=True)
class Conditioning:
    """How well the active rows fix the answer.

    Attributes:
        condition: largest over least singular value of the active rows, those
            that are zero to rounding left out.
        primal: whether x is fixed well.
        dual: whether the multipliers are, too: no active row depends on others.
    """

    condition: float
    primal: bool
    dual: bool


@dataclass(frozen=True, eq=False)
class Answer:
    """A point with its multipliers in qpsolvers' signs, and its residual."""

    x: Array
    duals: Duals
    residual: float


def answer_of(qp: Dense, x: Array, duals: Duals) -> Answer:
    """An answer judged by us; multipliers of rows that are zero are set to zero.

    Args:
        qp: the programme.
        x: a point.
        duals: its multipliers.
    """
    y = np.where(np.any(qp.A != 0.0, axis=1), duals.y, 0.0)
    z = np.where(np.any(qp.G != 0.0, axis=1), duals.z, 0.0)
    plain = Duals(y, z, duals.z_box)
    return Answer(x, plain, kkt_residual(qp, x, plain).worst)


def conditioning(qp: Dense, x: Array) -> Conditioning:
    """Of the rows and bounds that hold x.

    Args:
        qp: the programme.
        x: its optimum, or close to it.
    """
    rows = _active_rows(qp, x)
    _, sizes, right = np.linalg.svd(rows, full_matrices=True)
    top = float(sizes.max(initial=0.0))
    kept = sizes[sizes > _RANK * max(top, 1e-300)]
    condition = top / float(kept.min()) if kept.size else 1.0
    kernel = right[kept.size :].T
    curvature = np.linalg.eigvalsh(kernel.T @ qp.P @ kernel)
    largest = float(np.abs(qp.P).max(initial=0.0))
    curved = float(curvature.min(initial=np.inf)) >= CURVATURE * largest
    well = condition <= CONDITION and curved
    return Conditioning(condition, well, well and kept.size == len(rows))


def truth(qp: Dense, answers: Iterable[Answer]) -> Answer | None:
    """The optimum by one linear solve on the active rows of the best answer.

    Args:
        qp: the programme.
        answers: several; the one of the least residual proposes the rows.

    Returns:
        The optimum; the best answer where what was solved is no KKT point;
        None where that is none either.
    """
    best = min(answers, key=lambda a: a.residual, default=None)
    if best is None:
        return None
    on_rows, on_bounds = _held(qp, best)
    bound = np.where(best.duals.z_box > 0.0, qp.ub, qp.lb)
    rows = np.vstack([qp.A, qp.G[on_rows], np.eye(best.x.size)[on_bounds]])
    sides = np.concatenate([qp.b, qp.h[on_rows], bound[on_bounds]])
    x, multipliers = _equality_constrained(qp, rows, sides)
    p, m = len(qp.b), int(on_rows.sum())
    z, z_box = np.zeros(len(qp.h)), np.zeros(x.size)
    z[on_rows], z_box[on_bounds] = multipliers[p : p + m], multipliers[p + m :]
    duals = Duals(multipliers[:p], z, z_box)
    solved = Answer(x, duals, kkt_residual(qp, x, duals).worst)
    for answer in (solved, best):
        if answer.residual <= EXACT * (1.0 + _largest(_flat(answer.duals))):
            return answer
    return None


def primal_distance(first: Answer, second: Answer) -> float:
    """Largest |difference| in x."""
    return _largest(first.x - second.x)


def dual_distance(first: Answer, second: Answer) -> float:
    """Largest |difference| in a multiplier, over 1 + the largest multiplier."""
    one, two = _flat(first.duals), _flat(second.duals)
    return _largest(one - two) / (1.0 + _largest(two))


def is_right(answer: Answer, exact: Answer | None, known: Conditioning) -> bool:
    """Whether an answer is right, by the rule at the top of this file.

    Args:
        answer: to be judged.
        exact: the truth, where there is one.
        known: conditioning of the programme.
    """
    scale = 1.0 + _largest(_flat(answer.duals))
    if exact is None or not known.primal:
        return answer.residual <= TOLERANCE * scale
    if known.dual and dual_distance(answer, exact) > TOLERANCE:
        return False
    return primal_distance(answer, exact) <= TOLERANCE


def _equality_constrained(qp: Dense, rows: Array, sides: Array) -> tuple[Array, Array]:
    """Least 1/2 x'Px + q'x with rows x = sides; of least norm where not unique."""
    n, k = qp.q.size, len(rows)
    matrix = np.block([[qp.P, rows.T], [rows, np.zeros((k, k))]])
    right = np.concatenate([-qp.q, sides])
    solution = np.linalg.lstsq(matrix, right, rcond=1e-14)[0]
    solution += np.linalg.lstsq(matrix, right - matrix @ solution, rcond=1e-14)[0]
    return solution[:n], solution[n:]


def _held(qp: Dense, best: Answer) -> tuple[Mask, Mask]:
    """Rows and bounds with a multiplier that outweighs their slack."""
    slack = np.where(np.isfinite(qp.h), qp.h - qp.G @ best.x, np.inf)
    up, down = qp.ub - best.x, best.x - qp.lb
    z, box = best.duals.z, best.duals.z_box
    on_rows = z > np.maximum(slack, 0.0)
    on_bounds = np.abs(box) > np.maximum(np.where(box > 0.0, up, down), 0.0)
    return on_rows, on_bounds


def _active_rows(qp: Dense, x: Array) -> Array:
    on_row = qp.h - qp.G @ x <= _ACTIVE
    on_bound = (qp.ub - x <= _ACTIVE) | (x - qp.lb <= _ACTIVE)
    rows = np.vstack([qp.A, qp.G[on_row], np.eye(x.size)[on_bound]])
    return rows[np.any(rows != 0.0, axis=1)]


def _flat(duals: Duals) -> Array:
    return np.concatenate([duals.y, duals.z, duals.z_box])


def _largest(values: Array) -> float:
    return float(np.max(np.abs(values), initial=0.0))
