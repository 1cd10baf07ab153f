"""The projected primal-dual network (6)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rrnn_opt.arguments import checked
from rrnn_opt.dynamics import NeuralDynamics
from rrnn_opt.formulation import Formulation
from rrnn_opt.networks.coefficients import coefficients
from rrnn_opt.networks.parts import lagrangian_parts
from rrnn_opt.networks.projection import ProjectionNetwork


@checked()
@dataclass(frozen=True)
class PrimalDual(ProjectionNetwork[NeuralDynamics]):
    """The rule that turns a formulation into the network (6).

        epsilon u'      = -u + P_Omega(u - dL/du)            (6a)
        epsilon lambda' = dL/dlambda = equality rows         (6b)
        epsilon mu'     = -mu + max(mu + g, 0)               (inequality rows; ours)

    that is ``epsilon z' = P_Z(z - F(z)) - z``: its equilibria are the KKT
    points.  A formulation without rows leaves (6a) alone, whose state is u.

    With positive definite P, parameters that stand still, a feasible programme
    and u(0) in Omega, u converges to the optimum for every epsilon (for
    equality rows and bounds).  With P only semidefinite it need not:
    P = 0, J = 1 circles for ever.  If no u in Omega satisfies the rows,
    lambda grows without bound.

    Attributes:
        epsilon: time constant, s.
        whiten, delta: see ``ProjectionNetwork``.

    Raises:
        RrnnError: epsilon or delta is not positive and finite.

    Source:
        Li, Li, Hannaford (IEEE TII 2019), eq. (6).  The paper has no
        inequality rows besides the box, and no whitening.
    """

    definite = True

    epsilon: float = 0.01

    def euler_bound(self, form: Formulation, **parameters: ArrayLike) -> float:
        """The step at which no mode grows, whichever bounds and rows are active.

        A projected coordinate has the mode -1/epsilon.  The others are minus
        the eigenvalues s of a principal part of H over epsilon; with p- <= P <=
        p+ and sigma the largest singular value of the rows, s is real and at
        most max(p+, 1), or |s| <= sigma and Re s >= p-/2.  Hence

            h <= epsilon min(2, 2 / p+, p- / sigma^2).

        Args:
            form: what the network is made from.
            **parameters: one array a parameter of the formulation.

        Returns:
            The bound, s; 0 when the Hessian is singular.
        """
        P, A, G = coefficients(self.conditioned(form), parameters)
        curvature = np.linalg.eigvalsh(P)
        sigma = np.linalg.norm(np.vstack([A, G]), 2) if len(A) + len(G) else 0.0
        swing = curvature[0] / sigma**2 if sigma > 0.0 else np.inf
        longest = min(2.0, 2.0 / max(curvature[-1], 1.0), swing)
        return self.epsilon * max(float(longest), 0.0)

    def _made(self, form: Formulation) -> NeuralDynamics:
        parts = lagrangian_parts(form)
        return NeuralDynamics(
            name=f"primal_dual_{form.name}",
            derivative=parts["residual"] / self.epsilon,
            **parts,
        )
