"""The dual neural network of Zhang and Wang."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rrnn_opt.arguments import checked
from rrnn_opt.dynamics import NeuralDynamics
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks.coefficients import coefficients, inverse_hessian
from rrnn_opt.networks.dual_parts import DualParts, DualProjection


@checked()
@dataclass(frozen=True)
class DualNetwork(DualProjection[NeuralDynamics]):
    """The network whose neurons are the dual variables alone.

        epsilon u' = P_[low, high](C M (C'u - q) - u) - C M (C'u - q),
        x = M (C'u - q),   C = [A; G; I],   M = P^-1,
        low = [b; -inf; lb],   high = [b; h; ub].

    Its state is kept in our signs, u = (lambda, -mu, -z_box):

        epsilon lambda' = b - A x
        epsilon mu'     = max(mu + G x - h, 0) - mu
        epsilon z'      = x - P_Omega(x + z).

    It needs P^-1, which is constant: for P = I no inverse at all.  A
    positive definite P makes x unique; it converges wherever the programme
    has a solution.  Where rows depend on each other some multipliers are not
    unique, and each start leads to one of them.

    Attributes:
        epsilon: time constant, s.
        whiten, delta: see ``ProjectionNetwork``.

    Raises:
        RrnnError: epsilon or delta is not positive and finite.

    Source:
        Y. Zhang, J. Wang, "Obstacle avoidance for kinematically redundant
        manipulators using a dual neural network", IEEE Trans. SMC-B 34(1),
        2004.  A formulation without rows and bounds has one neuron a
        coordinate that fades to zero; that is ours.
    """

    epsilon: float = 0.01

    def euler_bound(self, form: Formulation, **parameters: ArrayLike) -> float:
        """``2 epsilon / max(1, |C M C'|)``: no mode grows, whatever is active.

        The modes are -1 and those of principal parts of -C M C' over epsilon,
        all real.

        Args:
            form: what the network is made from.
            **parameters: one array a parameter of the formulation.
        """
        M = inverse_hessian(form, "DualNetwork")
        _, A, G = coefficients(self.conditioned(form), parameters)
        C = np.vstack([A, G, np.eye(len(M)) if form.qp.bounded else A[:0]])
        size = np.linalg.norm(C @ M @ C.T, 2) if len(C) else 0.0
        return float(2.0 * self.epsilon / max(1.0, size))

    def _made(self, form: Formulation) -> NeuralDynamics:
        parts = DualParts.of(form, "DualNetwork")
        return NeuralDynamics(
            name=f"dual_network_{form.name}",
            derivative=parts.residual / self.epsilon,
            **parts.common(),
        )
