"""The simplified primal-dual network of linear variational inequalities."""

from __future__ import annotations

from dataclasses import dataclass, replace

from numpy.typing import ArrayLike

from rrnn_opt.dynamics import NeuralDynamics
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks.network import Needs, Network, require_positive
from rrnn_opt.networks.primal_dual import PrimalDual


@dataclass(frozen=True)
class SimplifiedLviPdnn(Network):
    """``y' = gamma (P_Z(y - (H y + p)) - y)``, y = (u, lambda, mu).

    ``LviPdnn`` without the factor ``I + H'``.  Written out it is the network
    (6) with epsilon = 1/gamma, term by term, and is made by that rule: the two
    schools met at one network.  What is lost with the factor is convergence
    for a semidefinite Hessian.

    Attributes:
        gamma: rate, 1/s.
        whiten: whether the equality rows are whitened; see ``whitening``.
        delta: of the whitening.

    Raises:
        RrnnError: gamma or delta is not positive and finite.

    Source:
        The form in public code of Y. Zhang's school (S-LVI-PDNN); that it is
        (6) is our reading, held by a test.
    """

    gamma: float = 100.0
    whiten: bool = False
    delta: float = 1e-6

    def __post_init__(self) -> None:
        require_positive("SimplifiedLviPdnn", gamma=self.gamma, delta=self.delta)

    def __call__(self, form: Formulation) -> NeuralDynamics:
        """The network of ``form``; state (u, lambda, mu), output u."""
        return replace(self._rule(form), name=f"simplified_lvi_pdnn_{form.name}")

    def needs(self, form: Formulation) -> Needs:
        """What ``PrimalDual`` needs."""
        return self._rule.needs(form)

    @property
    def operations(self) -> frozenset[str]:
        """Those of ``PrimalDual``."""
        return self._rule.operations

    def euler_bound(self, form: Formulation, **parameters: ArrayLike) -> float:
        """That of ``PrimalDual``."""
        return self._rule.euler_bound(form, **parameters)

    @property
    def _rule(self) -> PrimalDual:
        return PrimalDual(1.0 / self.gamma, whiten=self.whiten, delta=self.delta)
