"""The zeroing network whose gain grows with time, up to a cap."""

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
from rrnn_opt.symbolic.symbol import Symbol


@checked()
@dataclass(frozen=True)
class VaryingGainZnn(Network):
    """``d error / dt = -min(g, cap) error`` with a gain g that grows.

        g' = growth g  while g < cap,    g(0) = gamma

    on the KKT equations: the gain is gamma exp(growth t) until it is capped.
    The published gains grow without end, which no fixed step survives; the cap
    is what makes it run on a computer, and gives it an equilibrium.  The linear
    solve is damped as ``A P^-1 A' + delta I``.

    Attributes:
        gamma: gain at the start, 1/s.
        growth: rate of the gain, 1/s.
        cap: largest gain, 1/s, above gamma.
        damping: delta of the solve ``A P^-1 A' + delta I``, 1.

    Raises:
        RrnnError: a number is not positive and finite, or the cap is not above
            gamma.

    Source:
        Y. Kong, Q. Tang, J. Lei, R. Zhang, "An exponential varying-parameter
        neural network for repetitive tracking of mobile manipulators",
        Complexity 2020, 8520835 (a gain that grows exponentially); the cap and
        the gain as a state are ours.
    """

    gamma: float = 10.0
    growth: float = 20.0
    cap: float = 200.0
    damping: float = 1e-9

    def __post_init__(self) -> None:
        require_positive(
            "VaryingGainZnn",
            gamma=self.gamma,
            growth=self.growth,
            cap=self.cap,
            damping=self.damping,
        )
        if not self.cap > self.gamma:
            raise RrnnError(f"VaryingGainZnn: cap {self.cap} is not above gamma")

    @checked()
    def __call__(self, form: Formulation) -> NeuralDynamics:
        """The network of ``form``; state (u, lambda, g), output u.

        Its parameters are those of ``form``, then their time derivatives.  The
        equilibrium is where the error is zero and the gain at its cap.

        Raises:
            RrnnError: the formulation has bounds, inequality rows or a singular
                Hessian.
        """
        kkt = Kkt.of(form, "VaryingGainZnn", self.damping)
        gain = ca.SX.sym("gain")
        state = Symbol(
            "state",
            ca.vertcat(kkt.state.sx, gain),
            f"{kkt.state.unit}, 1/s",
            f"{kkt.state.meaning}, and the gain",
        )
        wanted = -ca.fmin(gain, self.cap) * kkt.error
        growing = ca.if_else(gain < self.cap, self.growth * gain, 0)
        short = ca.fmax(self.cap - gain, 0)
        return NeuralDynamics(
            name=f"varying_gain_znn_{form.name}",
            state=state,
            derivative=ca.vertcat(kkt.solve(wanted), growing),
            residual=ca.vertcat(-kkt.error, short),
            start=ca.vertcat(ca.SX.zeros(kkt.state.size, 1), self.gamma),
            longest_step=1.0 / self.cap,
            **kkt.common(),
        )

    def needs(self, form: Formulation) -> Needs:
        """A linear solve in every step, rates, and one neuron for the gain."""
        return kkt_needs(form, extra=1)

    @property
    def operations(self) -> frozenset[str]:
        """Products, sums, a factorisation, and the switch of the gain."""
        return ARITHMETIC | OPERATIONS | {"fmin", "lt", "if_else_zero"}

    def euler_bound(self, form: Formulation, **parameters: ArrayLike) -> float:
        """``2 / cap``: the modes at the largest gain."""
        return 2.0 / self.cap
