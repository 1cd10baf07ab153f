"""Solvers side by side on one stream, every answer judged by us."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rrnn_opt.arguments import checked, require_parts
from rrnn_opt.errors import ArgumentError
from rrnn_opt.solving.parts import Array, Dense
from rrnn_opt.solving.protocol import Instance, Solution, Solver
from rrnn_opt.solving.residual import Residual
from rrnn_opt.solving.status import Status
from rrnn_opt.solving.stream import Stream

ACTIVE = 1e-7
"""A row or bound this close to its limit counts as active."""

INDEPENDENT = 1e-3
"""Active rows whose smallest singular value is below this do not fix their
multipliers well enough to compare them."""


@checked()
@dataclass(frozen=True)
class Tolerances:
    """What counts as the same answer.

    Attributes:
        primal: largest difference in x (a joint velocity: rad/s or m/s).
        dual: largest difference in a multiplier that is unique.
        residual: largest KKT residual.

    Raises:
        ArgumentError: one is negative.
    """

    primal: float = 1e-6
    dual: float = 1e-5
    residual: float = 1e-6

    def __post_init__(self) -> None:
        """Refuse what no difference can be within."""
        if min(self.primal, self.dual, self.residual) < 0.0:
            raise ArgumentError("tolerances", "expected numbers of at least 0")


@dataclass(frozen=True)
class Comparison:
    """One solver on one QP, against the first solver's answer.

    Attributes:
        index: of the QP in the stream.
        solver: name.
        mode: "cold" or "warm".
        status: our judgement.
        primal: largest |difference| in x; NaN when either has no point.
        equality: the same for the equality multipliers, NaN also where the
            active rows do not make the multipliers unique.
        box: the same for the multipliers of bounds and inequalities.
        residual: KKT residuals of this solver's answer, computed by us.
        time_s: of update and solve, s.
        agrees: solved alike and within the tolerances; or the same verdict
            that there is no point.
    """

    index: int
    solver: str
    mode: str
    status: Status
    primal: float
    equality: float
    box: float
    residual: Residual
    time_s: float
    agrees: bool


@checked()
def compare(
    stream: Stream, solvers: Sequence[Solver], *, tolerances: Tolerances | None = None
) -> list[Comparison]:
    """Each QP of the stream through each solver.

    Args:
        stream: QPs of one shape.
        solvers: the first one is what the others are compared with.
        tolerances: what counts as the same answer.

    Returns:
        One row a QP and solver, QP by QP; the first solver's differences from
        itself are zero.

    Raises:
        ArgumentError: one of the solvers is none, such as a name: write
            ``Qpsolvers("osqp")``.
    """
    for solver in solvers:
        require_parts(solver, "solvers", ("setup", "update", "solve", "name", "mode"))
    limits = Tolerances() if tolerances is None else tolerances
    rows: list[Comparison] = []
    for index, instance in enumerate(stream.instances):
        answers = [_solve(solver, instance, first=index == 0) for solver in solvers]
        unique = multipliers_unique(instance, answers[0]) if answers else False
        for solver, answer in zip(solvers, answers, strict=True):
            rows.append(_row(index, solver, answer, answers[0], unique, limits))
    return rows


def multipliers_unique(instance: Instance, answer: Solution) -> bool:
    """Whether the active rows and bounds at x are well independent.

    Args:
        instance: the QP.
        answer: of any solver.
    """
    if answer.x is None:
        return False
    qp, x = Dense.of(instance.problem), answer.x
    on_row = qp.h - qp.G @ x <= ACTIVE
    on_bound = (qp.ub - x <= ACTIVE) | (x - qp.lb <= ACTIVE)
    active = np.vstack([qp.A, qp.G[on_row], np.eye(x.size)[on_bound]])
    if len(active) == 0:
        return True
    if len(active) > x.size:
        return False
    return bool(np.linalg.svd(active, compute_uv=False)[-1] >= INDEPENDENT)


def _solve(solver: Solver, instance: Instance, *, first: bool) -> Solution:
    (solver.setup if first else solver.update)(instance)
    return solver.solve()


def _row(
    index: int,
    solver: Solver,
    answer: Solution,
    reference: Solution,
    unique: bool,
    limits: Tolerances,
) -> Comparison:
    primal = equality = box = math.nan
    if answer.x is not None and reference.x is not None:
        primal = _largest(answer.x - reference.x)
        if unique and answer.duals is not None and reference.duals is not None:
            ours, theirs = answer.duals, reference.duals
            equality = _largest(ours.y - theirs.y)
            box = max(_largest(ours.z - theirs.z), _largest(ours.z_box - theirs.z_box))
    return Comparison(
        index=index,
        solver=solver.name,
        mode=solver.mode,
        status=answer.status,
        primal=primal,
        equality=equality,
        box=box,
        residual=answer.residual,
        time_s=answer.time_s,
        agrees=_agrees(answer, reference, (primal, equality, box), limits),
    )


def _agrees(
    answer: Solution,
    reference: Solution,
    differences: tuple[float, float, float],
    limits: Tolerances,
) -> bool:
    """A difference that could not be measured (NaN multipliers) does not count."""
    if answer.x is None or reference.x is None:
        infeasible = Status.PRIMAL_INFEASIBLE
        return answer.status is infeasible and reference.status is infeasible
    primal, equality, box = differences
    return (
        primal <= limits.primal
        and not equality > limits.dual
        and not box > limits.dual
        and answer.residual.worst <= limits.residual
    )


def _largest(values: Array) -> float:
    return float(np.max(np.abs(values), initial=0.0))
