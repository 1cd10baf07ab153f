"""How long an Euler step of (18) may be, and how large its drive can get.

The Hessian of |e|^2 / 2 has the elements J_i . J_j - e . d2f/dq_i dq_j, so with
|e| <= E its norm is at most that of A, A_ij = |J_i . J_j| + E |d2f/dq_i dq_j|,
and A, symmetric and nowhere negative, has norm at most max_i (A x)_i / x_i for
every x > 0.  Natural interval forms bound all elements over a box.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np

from rrnn_opt.robot import Kinematics
from rrnn_opt.verification.engines.interval.kernel import Array, IntervalKernel
from rrnn_opt.verification.region.reduced import ReducedArm

_GROW = 1.0 + 1e-12
_TURN = 1.0 + 1e-11  # a rotation within 1e-14, squared and more


@dataclass(frozen=True, eq=False)
class Curvature:
    """Kernel of J'J and of the squared norms of f's second derivatives.

    Attributes:
        joints: nv.
        kernel: upper triangles of both, one after the other.
    """

    joints: int
    kernel: IntervalKernel

    @staticmethod
    def of(kinematics: Kinematics, arm: ReducedArm, frame: str | None) -> Curvature:
        """Compile the kernel, in the joints that matter."""
        q, nv = kinematics.q, kinematics.q.numel()
        J = kinematics.jacobian(frame)[list(arm.rows), :]
        second = ca.reshape(ca.jacobian(ca.vec(J), q), J.numel(), nv)
        pairs = [(i, j) for i in range(nv) for j in range(i, nv)]
        n = len(arm.rows)
        columns = [ca.dot(J[:, i], J[:, j]) for i, j in pairs]
        bends = [ca.sumsqr(second[j * n : (j + 1) * n, i]) for i, j in pairs]
        where = {k: arm.q[i] for i, k in enumerate(arm.joints)}
        given = ca.vertcat(*[where.get(k, ca.SX(0)) for k in range(nv)])
        both = ca.substitute(ca.vertcat(*columns, *bends), q, given)
        function = ca.Function("curvature", [arm.q], [ca.densify(ca.cse(both))])
        return Curvature(nv, IntervalKernel.of(function))

    def __call__(self, lower: Array, upper: Array, error: float) -> tuple[float, float]:
        """Largest L, and largest column of J, over all boxes.

        Args:
            lower: (k, B), B >= 1.
            upper: (k, B).
            error: E, m.

        Returns:
            L >= the norm of the Hessian of |e|^2/2, m2; sup |J_i|, m.  Infinite
            where there is no bound.
        """
        found = self.kernel(lower, upper)
        if not found.bounded.all():
            return np.inf, np.inf
        pairs = self.joints * (self.joints + 1) // 2
        most = np.maximum(np.abs(found.lower), np.abs(found.upper))
        dots, bends = most[:pairs], np.sqrt(most[pairs:]) * _GROW
        index = np.zeros((self.joints, self.joints), int)
        index[np.triu_indices(self.joints)] = np.arange(pairs)
        A = (dots + error * bends)[np.maximum(index, index.T)]
        x = np.ones(A.shape[1:])
        for _ in range(6):
            x = np.einsum("ijb,jb->ib", A, x)
            x = x / x.max(axis=0) + 1e-6
        norm = np.max(np.einsum("ijb,jb->ib", A, x) / x) * _GROW * _TURN
        diagonal = [k * self.joints - k * (k - 1) // 2 for k in range(self.joints)]
        column = np.sqrt(float(np.max(dots[diagonal]))) * _GROW * _TURN
        return float(norm), column
