"""The short-term-memory cell (14) that chooses random or heuristic search."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.errors import RrnnError


@checked()
@dataclass(frozen=True)
class MemoryCell:
    """One shunting short-term-memory cell, integrated exactly.

    With activity x in [0, 1] and input I (1 after an exploration that did not
    reach its target, 0 after one that did):

        dx/dt = -A x + (1 - x) (I + w [x]^+)                           (14)

    On [0, 1] this is the Riccati equation x' = I - beta x - w x^2 with
    beta = A + I - w, whose flow over a time T is, with
    D = sqrt(beta^2 + 4 w I) and E = exp(-D T),

        x(T) = (x (D (1 + E) - beta (1 - E)) + 2 I (1 - E))
               / ((2 w x + beta) (1 - E) + D (1 + E)).

    Attributes:
        decay: A of (14), positive, passive decay rate, 1/unit of time.
        self_excitation: w > 0, w != A, 1/unit of time.
        duration: T > 0, time that one exploration takes, units of time.

    Raises:
        RrnnError: a parameter is out of its range.

    Source:
        Li, Li, Hannaford (IEEE TII 2019), eq. (14), A = 0.9, w = 0.95.  The
        paper gives no time scale; one unit an exploration is our choice, and
        the exact flow takes the place of a discretisation (explicit Euler
        with a unit step leaves [0, 1]).
    """

    decay: float = 0.9
    self_excitation: float = 0.95
    duration: float = 1.0

    def __post_init__(self) -> None:
        if min(self.decay, self.self_excitation, self.duration) <= 0.0:
            raise RrnnError("memory cell: A, w and the duration must be positive")
        if abs(self.decay - self.self_excitation) < 1e-6:
            raise RrnnError("memory cell: A = w has no exponential flow; change w")

    def derivative(self, x: ca.SX, stimulus: ca.SX) -> ca.SX:
        """Right-hand side of (14), a scalar, 1 a unit of time.

        Args:
            x: activity, scalar, 1.
            stimulus: I >= 0, scalar, 1.
        """
        excitation = stimulus + self.self_excitation * ca.fmax(x, 0)
        return -self.decay * x + (1 - x) * excitation

    def flow(self, x: ca.SX, stimulus: ca.SX) -> ca.SX:
        """Activity x(T) after one exploration, a scalar; exact for x in [0, 1], I >= 0.

        Args:
            x: activity before, scalar, 1.
            stimulus: I, constant over the exploration, scalar, 1.
        """
        w = self.self_excitation
        beta = self.decay + stimulus - w
        root = ca.sqrt(beta**2 + 4 * w * stimulus)
        fade = ca.exp(-root * self.duration)
        numerator = x * (root * (1 + fade) - beta * (1 - fade))
        denominator = (2 * w * x + beta) * (1 - fade) + root * (1 + fade)
        return (numerator + 2 * stimulus * (1 - fade)) / denominator

    def function(self, name: str = "memory_cell") -> ca.Function:
        """``(activity, stimulus) -> next``, as a CasADi function.

        Args:
            name: of the function.
        """
        x, stimulus = ca.SX.sym("activity"), ca.SX.sym("stimulus")
        return ca.Function(
            name,
            [x, stimulus],
            [self.flow(x, stimulus)],
            ["activity", "stimulus"],
            ["next"],
        )
