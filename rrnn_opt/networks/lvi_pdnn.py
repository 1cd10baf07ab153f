"""The primal-dual network of linear variational inequalities."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rrnn_opt.arguments import checked
from rrnn_opt.dynamics import NeuralDynamics
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks.coefficients import monotone_matrix
from rrnn_opt.networks.parts import lagrangian_parts, transposed
from rrnn_opt.networks.projection import ProjectionNetwork


@checked()
@dataclass(frozen=True)
class LviPdnn(ProjectionNetwork[NeuralDynamics]):
    """``y' = gamma (I + H') (P_Z(y - (H y + p)) - y)``, y = (u, lambda, mu).

    H is the matrix of the monotone map F(y) = H y + p of the KKT conditions.
    The factor I + H' makes every step go nearer to every solution at once, for
    a semidefinite Hessian too:

        (y - y*)' (I + H') (P_Z(y - F(y)) - y) <= -|P_Z(y - F(y)) - y|^2.

    Attributes:
        gamma: rate, 1/s.
        whiten, delta: see ``ProjectionNetwork``.

    Raises:
        RrnnError: gamma or delta is not positive and finite.

    Source:
        LVI-PDNN of Y. Zhang's school, as in public reproductions of it; the
        inequality is B. He's (Applied Mathematics and Optimization 35, 1997).
    """

    gamma: float = 100.0

    def euler_bound(self, form: Formulation, **parameters: ArrayLike) -> float:
        """``2 / (gamma |I + H|^2)``: below it no step goes away from a solution.

        This holds from every state, whatever is active.  Longer steps often
        work: with orthonormal rows and P = I the bound is 0.38/gamma, and 0.5
        has been seen to settle.

        Args:
            form: what the network is made from.
            **parameters: one array a parameter of the formulation.
        """
        H = monotone_matrix(self.conditioned(form), parameters)
        size = np.linalg.norm(np.eye(len(H)) + H, 2)
        return float(2.0 / (self.gamma * size**2))

    def _made(self, form: Formulation) -> NeuralDynamics:
        parts = lagrangian_parts(form)
        back = parts["residual"]
        step = back + transposed(form.lagrangian, back)
        return NeuralDynamics(
            name=f"lvi_pdnn_{form.name}", derivative=self.gamma * step, **parts
        )
