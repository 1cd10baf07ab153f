"""Sets of QPs to compare solvers on, each with the truth about its feasibility."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.solving import Instance, find_farkas

SOLVABLE, INFEASIBLE, UNKNOWN = "solvable", "infeasible", "unknown"


@dataclass(frozen=True, eq=False)
class ProblemSet:
    """QPs in order.

    Attributes:
        name: for tables, e.g. "circle/pa10".
        instances: the QPs, of one shape when they are a sequence.
        truth: of each: "solvable" (a feasible point is known and the cost is
            bounded below on the set), "infeasible" (a Farkas certificate is
            known) or "unknown".
        sequence: whether one follows from the other, so that a warm start means
            something; then all have one shape.
        about: one sentence.
        scheme: makes the formulation that they come from; None where there is none.

    Raises:
        RrnnError: no problem, or not one truth for each.
    """

    name: str
    instances: tuple[Instance, ...]
    truth: tuple[str, ...]
    sequence: bool
    about: str
    scheme: Callable[[], Formulation] | None = None

    def __post_init__(self) -> None:
        if len(self.instances) != len(self.truth) or not self.instances:
            raise RrnnError(f"{self.name}: needs one truth a problem, and a problem")

    def __len__(self) -> int:
        return len(self.instances)


def settled_truth(instances: Sequence[Instance]) -> tuple[str, ...]:
    """Truth of QPs of unknown origin.

    A Farkas certificate says "infeasible", an answer of DAQP or OSQP that passes
    our check "solvable"; anything else is unknown.
    """
    return tuple(_truth(instance) for instance in instances)


def _truth(instance: Instance) -> str:
    from rrnn_opt.solving import DaqpSession, OsqpSession, Status

    if find_farkas(instance.problem) is not None:
        return INFEASIBLE
    sessions: tuple[Any, ...] = (DaqpSession(mode="cold"), OsqpSession(mode="cold"))
    for solver in sessions:
        solver.setup(instance)
        if solver.solve().status is Status.SOLVED:
            return SOLVABLE
    return UNKNOWN
