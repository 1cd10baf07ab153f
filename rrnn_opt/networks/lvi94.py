"""The projection and contraction iteration 94LVI."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.dynamics import DiscreteDynamics
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks.parts import lagrangian_parts, transposed
from rrnn_opt.networks.projection import ProjectionMap

TINY = 1e-30
"""Keeps 0/0 out of the step length where the error is zero."""


@checked()
@dataclass(frozen=True)
class Lvi94(ProjectionMap):
    """``y+ = y - rho (I + H') e(y)``, y = (u, lambda, mu).

    The error and the step length are

        e(y) = y - P_Z(y - (H y + p)),   rho = |e|^2 / |(I + H') e|^2.

    ``LviPdnn`` as an iteration that chooses its own step: rho is the step that
    brings y nearest to the solutions as far as the inequality there tells.
    It settles any convex QP that has a solution.

    Attributes:
        whiten, delta: see ``ProjectionNetwork``.

    Raises:
        RrnnError: delta is not positive and finite.

    Source:
        B. He, "Solving a class of linear projection equations", Numerische
        Mathematik 68, 1994; called 94LVI by the users of it in robotics.
    """

    extra = frozenset({"sq", "div"})

    def _made(self, form: Formulation) -> DiscreteDynamics:
        parts = lagrangian_parts(form)
        back = parts["residual"]
        step = back + transposed(form.lagrangian, back)
        following = parts["state"].sx + length(back, step) * step
        return DiscreteDynamics(name=f"lvi94_{form.name}", next=following, **parts)


def length(error: ca.SX, step: ca.SX) -> ca.SX:
    """``rho = |error|^2 / |step|^2`` of ``Lvi94``, a scalar; 0 at a solution."""
    return ca.sumsqr(error) / ca.fmax(ca.sumsqr(step), TINY)
