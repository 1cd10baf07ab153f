"""Numbers of a formulation at one parameter point, for step bounds."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rrnn_opt.errors import RrnnError
from rrnn_opt.formulation import Formulation
from rrnn_opt.symbolic.values import arguments

Array = NDArray[np.float64]


def coefficients(
    form: Formulation, parameters: Mapping[str, ArrayLike]
) -> tuple[Array, Array, Array]:
    """P (n, n), A (p, n) and G (m, n) at given parameters.

    Raises:
        RrnnError: a parameter is missing, unknown, or of the wrong shape.
    """
    values = arguments(form.parameters, parameters, "euler_bound")
    made = form.qp.functions()["qp"].call(values)
    n = form.decision.size
    P, A, G = (np.asarray(made[k], dtype=np.float64).reshape(-1, n) for k in (0, 2, 4))
    return P, A, G


def monotone_matrix(form: Formulation, parameters: Mapping[str, ArrayLike]) -> Array:
    """H of the affine map ``F(z) = H z + p``, z = (u, lambda, mu)."""
    P, A, G = coefficients(form, parameters)
    p, m = len(A), len(G)
    return np.block(
        [
            [P, -A.T, G.T],
            [A, np.zeros((p, p + m))],
            [-G, np.zeros((m, p + m))],
        ]
    )


def inverse_hessian(form: Formulation, who: str) -> Array:
    """The inverse of the constant Hessian, (n, n); exactly I for I.

    Args:
        form: a formulation.
        who: the network that asks, for the message.

    Raises:
        RrnnError: the Hessian is singular.
    """
    P = form.qp.hessian
    least, *_, most = np.linalg.eigvalsh(P) if len(P) > 1 else (P[0, 0], P[0, 0])
    if not least > 1e-12 * max(most, 1e-300):
        raise RrnnError(
            f"{who}: {form.name} has a Hessian that is not positive definite "
            f"(eigenvalue {least:.3g}); it needs the inverse: add a small "
            "quadratic cost, or take LviPdnn"
        )
    if np.array_equal(P, np.diag(np.diag(P))):
        return np.diag(1.0 / np.diag(P))
    inverse = np.linalg.inv(P)
    return (inverse + inverse.T) / 2.0


def is_identity(matrix: Array) -> bool:
    """Whether a square matrix is exactly I."""
    return np.array_equal(matrix, np.eye(len(matrix)))
