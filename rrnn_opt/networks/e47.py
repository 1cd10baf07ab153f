"""The projection and contraction iteration E47."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca

from rrnn_opt.arguments import checked
from rrnn_opt.dynamics import DiscreteDynamics
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks.lvi94 import length
from rrnn_opt.networks.parts import lagrangian_parts, transposed
from rrnn_opt.networks.projection import ProjectionMap


@checked()
@dataclass(frozen=True)
class E47(ProjectionMap):
    """``y+ = P_Z(y - rho g(y))``, y = (u, lambda, mu).

    With e and rho as in ``Lvi94``,

        g(y) = H' e(y) + H y + p.

    Every iterate is within the bounds, which those of ``Lvi94`` need not be.

    Attributes:
        whiten, delta: see ``ProjectionNetwork``.

    Raises:
        RrnnError: delta is not positive and finite.

    Source:
        A second form of B. He's method of 1994 (see ``Lvi94``).  The name is that
        of the robotics literature; the formula is the one known to us, with its
        convergence seen and not proved here.
    """

    extra = frozenset({"sq", "div"})

    def _made(self, form: Formulation) -> DiscreteDynamics:
        parts = lagrangian_parts(form)
        law, back = form.lagrangian, parts["residual"]
        turned = transposed(law, back)
        pull = turned - law.map
        onward = parts["state"].sx + length(back, back + turned) * pull
        following = ca.SX(law.set.project(onward))
        return DiscreteDynamics(name=f"e47_{form.name}", next=following, **parts)
