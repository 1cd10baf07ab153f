"""What became of an attempt to solve a quadratic programme."""

from __future__ import annotations

from enum import Enum


class Status(Enum):
    """How a solve ended; the value is the sentence for a reader.

    A status is our own judgement from KKT residuals and certificates, never
    the word of a solver.
    """

    SOLVED = "the KKT residual is within the tolerance"
    SOLVED_INACCURATE = "the KKT residual is within a thousand tolerances only"
    PRIMAL_INFEASIBLE = "a Farkas certificate shows that no point is feasible"
    MAX_ITER = "the iteration did not settle within its steps"
    NUMERICAL = "the answer is not finite, is junk, or is far from optimal"
    NOT_AVAILABLE = "the solver is not installed or not licensed"
    ERROR = "the solver raised an error"

    @property
    def has_point(self) -> bool:
        """Whether a point comes with it that passed our own KKT check."""
        return self in (Status.SOLVED, Status.SOLVED_INACCURATE)

    @property
    def key(self) -> str:
        """Name for tables and files, e.g. "primal_infeasible"."""
        return self.name.lower()
