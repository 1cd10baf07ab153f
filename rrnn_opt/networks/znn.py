"""The zeroing neural network (Zhang neural network)."""

from __future__ import annotations

from dataclasses import dataclass

from numpy.typing import ArrayLike

from rrnn_opt.arguments import checked
from rrnn_opt.dynamics import NeuralDynamics
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks.kkt import OPERATIONS, Kkt, kkt_needs
from rrnn_opt.networks.network import ARITHMETIC, Needs, Network, require_positive


@checked()
@dataclass(frozen=True)
class Znn(Network):
    """``d error / dt = -gamma error`` for error = Phi y - v, y = (u, lambda).

    Written out,

        Phi y' = -Phi' y + v' - gamma (Phi y - v).

    The data may move: told their rates, the network follows the optimum with
    no lag, the error fading as exp(-gamma t).  It solves a linear system in
    every step, damped as ``A P^-1 A' + delta I`` (see ``kkt``), and
    equality-constrained programmes only.

    Attributes:
        gamma: rate, 1/s.
        damping: delta of the solve ``A P^-1 A' + delta I``, 1.

    Raises:
        RrnnError: gamma or damping is not positive and finite.

    Source:
        Y. Zhang, S. S. Ge, "Design and analysis of a general recurrent neural
        network model for time-varying matrix inversion", IEEE Trans. Neural
        Networks 16(6), 2005, on the KKT equations; the damping is ours.
    """

    gamma: float = 100.0
    damping: float = 1e-9

    def __post_init__(self) -> None:
        require_positive("Znn", gamma=self.gamma, damping=self.damping)

    @checked()
    def __call__(self, form: Formulation) -> NeuralDynamics:
        """The network of ``form``; state (u, lambda), output u.

        Its parameters are those of ``form``, then their time derivatives,
        called ``q_rate`` for ``q`` and so on.

        Raises:
            RrnnError: the formulation has bounds, inequality rows or a singular
                Hessian.
        """
        kkt = Kkt.of(form, "Znn", self.damping)
        return NeuralDynamics(
            name=f"znn_{form.name}",
            state=kkt.state,
            derivative=kkt.solve(-self.gamma * kkt.error),
            residual=-kkt.error,
            **kkt.common(),
        )

    def needs(self, form: Formulation) -> Needs:
        """A linear solve in every step, and rates."""
        return kkt_needs(form)

    @property
    def operations(self) -> frozenset[str]:
        """Products, sums, and a factorisation."""
        return ARITHMETIC | OPERATIONS

    def euler_bound(self, form: Formulation, **parameters: ArrayLike) -> float:
        """``2 / gamma``: every mode is -gamma, or slower where damped."""
        return 2.0 / self.gamma
