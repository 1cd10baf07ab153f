"""The noise-tolerant zeroing network: one with an integral."""

from __future__ import annotations

import math
from dataclasses import dataclass

import casadi as ca
from numpy.typing import ArrayLike

from rrnn_opt.arguments import checked
from rrnn_opt.dynamics import NeuralDynamics
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks.kkt import OPERATIONS, Kkt, kkt_needs
from rrnn_opt.networks.network import ARITHMETIC, Needs, Network, require_positive
from rrnn_opt.symbolic.symbol import Symbol


@checked()
@dataclass(frozen=True)
class NoiseTolerantZnn(Network):
    """``d error / dt = -gamma error - integral s``, s' = error.

    On the KKT equations,

        Phi y' = -Phi' y + v' - gamma (Phi y - v) - integral s + noise.

    The integral s is a state of its own.  A constant disturbance of the law is
    cancelled by it (s comes to rest at noise/integral), where ``Znn`` is left
    with the error noise/gamma.  The linear solve is damped as
    ``A P^-1 A' + delta I``.

    Attributes:
        gamma: rate, 1/s.
        integral: gain of the integral, 1/s2; the modes s^2 + gamma s +
            integral = 0 are real up to gamma^2 / 4.
        damping: delta of the solve ``A P^-1 A' + delta I``, 1.

    Raises:
        RrnnError: a number is not positive and finite.

    Source:
        L. Jin, Y. Zhang, S. Li, Y. Zhang, "Modified ZNN for time-varying
        quadratic programming with inherent tolerance to noises and its
        application to kinematic redundancy resolution of robot manipulators",
        IEEE Trans. Industrial Electronics 63(11), 2016.
    """

    gamma: float = 100.0
    integral: float = 1000.0
    damping: float = 1e-9

    def __post_init__(self) -> None:
        require_positive(
            "NoiseTolerantZnn",
            gamma=self.gamma,
            integral=self.integral,
            damping=self.damping,
        )

    @checked()
    def __call__(self, form: Formulation) -> NeuralDynamics:
        """The network of ``form``; state (u, lambda, s), output u.

        Its parameters are those of ``form``, then their time derivatives.

        Raises:
            RrnnError: the formulation has bounds, inequality rows or a singular
                Hessian.
        """
        kkt = Kkt.of(form, "NoiseTolerantZnn", self.damping)
        size = kkt.state.size
        memory = ca.SX.sym("memory", size)
        state = Symbol(
            "state",
            ca.vertcat(kkt.state.sx, memory),
            kkt.state.unit,
            f"{kkt.state.meaning}, and the integral of the error",
        )
        wanted = -self.gamma * kkt.error - self.integral * memory
        return NeuralDynamics(
            name=f"noise_tolerant_znn_{form.name}",
            state=state,
            derivative=ca.vertcat(kkt.solve(wanted), kkt.error),
            residual=ca.vertcat(-kkt.error, -memory),
            **kkt.common(),
        )

    def needs(self, form: Formulation) -> Needs:
        """A linear solve in every step, rates, and the integral's neurons."""
        return kkt_needs(form, extra=form.decision.size + form.equalities.size1())

    @property
    def operations(self) -> frozenset[str]:
        """Products, sums, and a factorisation."""
        return ARITHMETIC | OPERATIONS

    def euler_bound(self, form: Formulation, **parameters: ArrayLike) -> float:
        """From the modes s^2 + gamma s + integral = 0."""
        inside = self.gamma**2 / 4.0 - self.integral
        if inside < 0.0:
            return self.gamma / self.integral
        return 2.0 / (self.gamma / 2.0 + math.sqrt(inside))
