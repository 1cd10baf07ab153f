"""The projection and contraction iteration 94LVI."""

from __future__ import annotations

import math
from dataclasses import dataclass

import casadi as ca
from numpy.typing import ArrayLike

from rrnn_opt.dynamics import DiscreteDynamics
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks import whitening
from rrnn_opt.networks.network import (
    ARITHMETIC,
    CLIPPING,
    Needs,
    Network,
    require_positive,
    rows,
)
from rrnn_opt.networks.parts import lagrangian_parts, transposed

TINY = 1e-30
"""Keeps 0/0 out of the step length where the error is zero."""


@dataclass(frozen=True)
class Lvi94(Network):
    """``y+ = y - rho (I + H') e(y)``, y = (u, lambda, mu).

    The error and the step length are

        e(y) = y - P_Z(y - (H y + p)),   rho = |e|^2 / |(I + H') e|^2.

    ``LviPdnn`` as an iteration that chooses its own step: rho is the step that
    brings y nearest to the solutions as far as the inequality there tells.
    It settles any convex QP that has a solution.

    Attributes:
        whiten: whether the equality rows are whitened; see ``whitening``.
        delta: of the whitening.

    Raises:
        RrnnError: delta is not positive and finite.

    Source:
        B. He, "Solving a class of linear projection equations", Numerische
        Mathematik 68, 1994; called 94LVI by the users of it in robotics.
    """

    whiten: bool = False
    delta: float = 1e-6

    def __post_init__(self) -> None:
        require_positive("Lvi94", delta=self.delta)

    def __call__(self, form: Formulation) -> DiscreteDynamics:
        """The iteration for ``form``; state (u, lambda, mu), output u."""
        if self.whiten:
            return whitening.whitened(self._made, form, self.delta)
        return self._made(form)

    def needs(self, form: Formulation) -> Needs:
        """No inverse unless whitened (rho divides two numbers)."""
        return Needs(
            inverse=whitening.inverse_of(form, whiten=self.whiten),
            duals=rows(form),
            state=form.decision.size + rows(form),
            definite=False,
        )

    @property
    def operations(self) -> frozenset[str]:
        """Products, sums, projections, and the division in rho."""
        extra = whitening.OPERATIONS if self.whiten else frozenset()
        return ARITHMETIC | CLIPPING | {"sq", "div"} | extra

    def euler_bound(self, form: Formulation, **parameters: ArrayLike) -> float:
        """Infinite: a map has no step size."""
        return math.inf

    def _made(self, form: Formulation) -> DiscreteDynamics:
        parts = lagrangian_parts(form)
        back = parts["residual"]
        step = back + transposed(form.lagrangian, back)
        following = parts["state"].sx + length(back, step) * step
        return DiscreteDynamics(name=f"lvi94_{form.name}", next=following, **parts)


def length(error: ca.SX, step: ca.SX) -> ca.SX:
    """The step length rho of ``Lvi94``; 0 at a solution."""
    return ca.sumsqr(error) / ca.fmax(ca.sumsqr(step), TINY)
