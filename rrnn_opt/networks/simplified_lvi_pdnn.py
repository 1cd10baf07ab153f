"""The simplified primal-dual network of linear variational inequalities."""

from __future__ import annotations

from dataclasses import dataclass, replace

from numpy.typing import ArrayLike

from rrnn_opt.arguments import checked
from rrnn_opt.dynamics import NeuralDynamics
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks.primal_dual import PrimalDual
from rrnn_opt.networks.projection import ProjectionNetwork


@checked()
@dataclass(frozen=True)
class SimplifiedLviPdnn(ProjectionNetwork[NeuralDynamics]):
    """``y' = gamma (P_Z(y - (H y + p)) - y)``, y = (u, lambda, mu).

    ``LviPdnn`` without the factor ``I + H'``.  Written out it is the network
    (6) with epsilon = 1/gamma, term by term, and is made by that rule: the two
    schools met at one network.  What is lost with the factor is convergence
    for a semidefinite Hessian.

    Attributes:
        gamma: rate, 1/s.
        whiten, delta: see ``ProjectionNetwork``.

    Raises:
        RrnnError: gamma or delta is not positive and finite.

    Source:
        Ours is the reading that it is (6) of Li, Li, Hannaford (IEEE TII 2019),
        held by a test; the form is that in public code of Y. Zhang's school
        (S-LVI-PDNN).
    """

    definite = True

    gamma: float = 100.0

    def euler_bound(self, form: Formulation, **parameters: ArrayLike) -> float:
        """That of ``PrimalDual``."""
        return self._rule.euler_bound(self.conditioned(form), **parameters)

    def _made(self, form: Formulation) -> NeuralDynamics:
        return replace(self._rule(form), name=f"simplified_lvi_pdnn_{form.name}")

    @property
    def _rule(self) -> PrimalDual:
        return PrimalDual(1.0 / self.gamma)
