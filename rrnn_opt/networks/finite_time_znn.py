"""The zeroing network with a sign-bi-power activation: rest in finite time."""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
from numpy.typing import ArrayLike

from rrnn_opt.arguments import checked
from rrnn_opt.dynamics import NeuralDynamics
from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks.kkt import OPERATIONS, Kkt, kkt_needs
from rrnn_opt.networks.network import ARITHMETIC, Needs, Network, require_positive


@checked()
@dataclass(frozen=True)
class FiniteTimeZnn(Network):
    """``d error / dt = -gamma phi(error)`` on the KKT equations.

    The activation is

        phi(e) = (|e|^r + |e|^(1/r)) sign(e) / 2,   0 < r < 1,

    element by element.  The first power reaches zero in a time of at most
    2 |e(0)|^(1-r) / (gamma (1 - r)), the second hurries large errors.

    Its slope at zero is infinite: Euler steps of h end in a flutter of size
    (h gamma / 4)^(1/(1-r)) about the equilibrium, so short steps are the price
    of a short time: ``h = 4 band^(1-r) / gamma``.  The linear solve is damped as
    ``A P^-1 A' + delta I``.

    Attributes:
        gamma: rate, 1/s.
        power: r, 1.
        band: flutter that ``euler_bound`` allows, in units of the error.
        damping: delta of the solve ``A P^-1 A' + delta I``, 1.

    Raises:
        RrnnError: a number is not positive and finite, or r is not below 1.

    Source:
        S. Li, S. Chen, B. Liu, "Accelerating a recurrent neural network to
        finite-time convergence for solving time-varying Sylvester equation by
        using a sign-bi-power activation function", Neural Processing Letters
        37, 2013.
    """

    gamma: float = 100.0
    power: float = 0.5
    band: float = 1e-10
    damping: float = 1e-9

    def __post_init__(self) -> None:
        require_positive(
            "FiniteTimeZnn",
            gamma=self.gamma,
            power=self.power,
            band=self.band,
            damping=self.damping,
        )
        if not self.power < 1.0:
            raise RrnnError(f"FiniteTimeZnn: power {self.power}: it must be below 1")

    @checked()
    def __call__(self, form: Formulation) -> NeuralDynamics:
        """The network of ``form``; state (u, lambda), output u.

        Its parameters are those of ``form``, then their time derivatives.

        Raises:
            RrnnError: the formulation has bounds, inequality rows or a singular
                Hessian.
        """
        kkt = Kkt.of(form, "FiniteTimeZnn", self.damping)
        return NeuralDynamics(
            name=f"finite_time_znn_{form.name}",
            state=kkt.state,
            derivative=kkt.solve(-self.gamma * self._activation(kkt.error)),
            residual=-kkt.error,
            longest_step=self._longest,
            **kkt.common(),
        )

    def needs(self, form: Formulation) -> Needs:
        """A linear solve in every step, and rates."""
        return kkt_needs(form)

    @property
    def operations(self) -> frozenset[str]:
        """Products, sums, a factorisation, signs and powers."""
        powers = {"sqrt", "sq"} if self.power == 0.5 else {"pow"}
        return ARITHMETIC | OPERATIONS | {"sign", "fabs"} | powers

    def euler_bound(self, form: Formulation, **parameters: ArrayLike) -> float:
        """The step whose flutter is as large as ``band``: 4 band^(1-r) / gamma."""
        return self._longest

    @property
    def _longest(self) -> float:
        return float(4.0 * self.band ** (1.0 - self.power) / self.gamma)

    def _activation(self, error: ca.SX) -> ca.SX:
        size = ca.fabs(error)
        powers = size**self.power + size ** (1.0 / self.power)
        return ca.sign(error) * powers / 2.0
