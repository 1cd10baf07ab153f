"""A solver over a stream: set up once, update, solve; networks alike."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Protocol

from rrnn_opt.solving.parts import Array, Duals
from rrnn_opt.solving.residual import NOT_JUDGED, Residual
from rrnn_opt.solving.status import Status


@dataclass(frozen=True, eq=False)
class Instance:
    """One member of a stream: the numbers, and the QP that they make.

    Attributes:
        problem: the ``qpsolvers.Problem``.
        parameters: parameter values of the formulation by name; what a network
            reads.  Empty for a QP that comes from no formulation.
    """

    problem: Any
    parameters: Mapping[str, Array] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Solution:
    """An answer that passed our own check, or a status that says why not.

    Attributes:
        x: (n,) minimiser, or None unless ``status.has_point``.
        duals: its multipliers in qpsolvers' signs, or None likewise.
        status: our judgement.
        residual: KKT residuals of what the solver returned.
        time_s: wall time of update and solve, s; building the problem excluded.
        message: the error of a solver that raised one.
        relative: the residuals relative to the sizes of their terms.
        inner_s: of ``time_s``, what the solver itself counts for solving, s; None
            where it does not say.
        iterations: as the solver counts them, or None.
        claims: whether the solver itself says that it solved the problem.
        handed: what it handed out: "none", "NaN", "junk", "zeros" or "numbers".
    """

    x: Array | None
    duals: Duals | None
    status: Status
    residual: Residual
    time_s: float
    message: str = ""
    relative: Residual = NOT_JUDGED
    inner_s: float | None = None
    iterations: int | None = None
    claims: bool | None = None
    handed: str = "none"


class Solver(Protocol):
    """What ``compare`` asks of a solver."""

    @property
    def name(self) -> str:
        """Name in tables, e.g. "osqp"."""
        ...

    @property
    def mode(self) -> str:
        """Either "cold" (set up anew each time) or "warm" (keeps its last answer)."""
        ...

    def setup(self, instance: Instance) -> None:
        """Take the first instance; what can be done once is done here.

        Args:
            instance: the numbers and the QP that they make.
        """
        ...

    def update(self, instance: Instance) -> None:
        """Take the next instance, of the same shapes.

        Args:
            instance: the numbers and the QP that they make.
        """
        ...

    def solve(self) -> Solution:
        """Solve the instance at hand."""
        ...
