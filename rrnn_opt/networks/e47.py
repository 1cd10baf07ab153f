"""The projection and contraction iteration E47."""

from __future__ import annotations

import math
from dataclasses import dataclass

import casadi as ca
from numpy.typing import ArrayLike

from rrnn_opt.dynamics import DiscreteDynamics
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks import whitening
from rrnn_opt.networks.lvi94 import length
from rrnn_opt.networks.network import (
    ARITHMETIC,
    CLIPPING,
    Needs,
    Network,
    require_positive,
    rows,
)
from rrnn_opt.networks.parts import lagrangian_parts, transposed


@dataclass(frozen=True)
class E47(Network):
    """``y+ = P_Z(y - rho g(y))``, y = (u, lambda, mu).

    With e and rho as in ``Lvi94``,

        g(y) = H' e(y) + H y + p.

    Every iterate is within the bounds, which those
    of ``Lvi94`` need not be.

    Attributes:
        whiten: whether the equality rows are whitened; see ``whitening``.
        delta: of the whitening.

    Raises:
        RrnnError: delta is not positive and finite.

    Source:
        A second form of B. He's method.  The name is that of the robotics
        literature; the formula is the one known to us, with its convergence
        seen and not proved here.
    """

    whiten: bool = False
    delta: float = 1e-6

    def __post_init__(self) -> None:
        require_positive("E47", delta=self.delta)

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
        law, back = form.lagrangian, parts["residual"]
        turned = transposed(law, back)
        pull = turned - law.map
        onward = parts["state"].sx + length(back, back + turned) * pull
        following = ca.SX(law.set.project(onward))
        return DiscreteDynamics(name=f"e47_{form.name}", next=following, **parts)
