"""A dense QP in coordinates in which its Hessian is the identity.

With P = L L' and v = L'x the programme ``min 1/2 x'Px + q'x`` becomes

    minimise    1/2 v'v + q~'v
    subject to  A~ v = b~      orthonormal rows, dependent ones left out
                G~ v <= h~     rows of length one: those of G, and of the bounds

Where P is singular or nearly so, ``P + rho I`` takes its place.  Multipliers
and the point are taken back to the programme as given.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rrnn_opt.errors import NotAQpError, NotFiniteError
from rrnn_opt.solving.parts import Array, Dense, Duals

RANK = 1e-10
"""A singular value below this, relative to the largest, makes a dependent row."""

SINGULAR = 1e-7
"""Eigenvalues of P this close together, relatively, need no proximal term."""

PROXIMAL = 1e-6
"""The proximal term rho, relative to the largest eigenvalue of P."""


@dataclass(frozen=True, eq=False)
class Scaled:
    """A programme in the coordinates v.

    Attributes:
        problem: as given.
        rho: of the proximal term, 0 where P needs none.
        back: L^-T, (n, n): x = back @ v.
        values: "cost" q~ (n,), "A" A~ (r, n), "b" (r,), "G" G~ (m, n), "h"
            (m,); parts without rows are left out.
        y_back: takes the multipliers of A~ to those of A, (meq, r).
        lengths: of the rows G~ before they were normalised, (m,).
        sigma: largest singular value of the rows that can be active together.
    """

    problem: Dense
    rho: float
    back: Array
    values: dict[str, Array]
    y_back: Array
    lengths: Array
    sigma: float

    @staticmethod
    def of(problem: Dense) -> Scaled:
        """Scale a programme.

        Args:
            problem: with P positive semidefinite.

        Raises:
            NotAQpError: P is not positive semidefinite.
            NotFiniteError: a coefficient is NaN or infinite, a bound is NaN.
        """
        _require(problem)
        rho = _proximal(problem.P)
        back = _inverse_transposed_factor(problem.P, rho)
        A, b, y_back = _orthonormal(problem.A @ back, problem.b)
        G, h, lengths = _normalised(problem, back)
        given = {"cost": back.T @ problem.q, "A": A, "b": b, "G": G, "h": h}
        values = {name: value for name, value in given.items() if value.size}
        sigma = _largest_singular(A, G, problem)
        return Scaled(problem, rho, back, values, y_back, lengths, sigma)

    @property
    def sizes(self) -> tuple[int, int, int]:
        """Unknowns, equality rows and inequality rows."""
        return len(self.back), self.y_back.shape[1], len(self.lengths)

    def cost_near(self, v: Array) -> Array:
        """q~ with the proximal term drawn to v, (n,)."""
        return self.values["cost"] - self.rho * (self.back.T @ (self.back @ v))

    def given(self, state: Array) -> tuple[Array, Duals]:
        """The point x and its multipliers from (v, lambda, mu).

        Args:
            state: (n + r + m,); lambda has the sign of (4).
        """
        n, r, _ = self.sizes
        rows = len(self.problem.h)
        mu = np.maximum(state[n + r :], 0.0) / self.lengths
        box = mu[rows : rows + n] - mu[rows + n :] if len(mu) > rows else np.zeros(n)
        return self.back @ state[:n], Duals(
            y=-self.y_back @ state[n : n + r], z=mu[:rows], z_box=box
        )


def _require(qp: Dense) -> None:
    for name in ("P", "q", "G", "A", "b"):
        if not np.isfinite(getattr(qp, name)).all():
            raise NotFiniteError(name)
    for name in ("h", "lb", "ub"):
        if np.isnan(getattr(qp, name)).any():
            raise NotFiniteError(name)


def _proximal(P: Array) -> float:
    """The rho that P needs, 0 where it is well definite."""
    low, high = np.linalg.eigvalsh((P + P.T) / 2)[[0, -1]]
    if low < -1e-10 * max(high, -low):
        advice = f"eigenvalue {low:g}; make P positive semidefinite"
        raise NotAQpError("P", "indefinite Hessian", advice)
    if low >= SINGULAR * high > 0.0:
        return 0.0
    return PROXIMAL * float(high) if high > 0.0 else 1.0


def _inverse_transposed_factor(P: Array, rho: float) -> Array:
    """L^-T of (P + P')/2 + rho I = L L'."""
    from scipy.linalg import solve_triangular

    identity = np.eye(len(P))
    factor = np.linalg.cholesky((P + P.T) / 2 + rho * identity)
    inverse: Array = solve_triangular(factor.T, identity)
    return inverse


def _orthonormal(A: Array, b: Array) -> tuple[Array, Array, Array]:
    """Orthonormal rows of the same span, their right sides, and the way back."""
    left, size, right = np.linalg.svd(A, full_matrices=False)
    kept = size > RANK * max(float(np.max(size, initial=0.0)), 1e-300)
    scaled = left[:, kept] / size[kept]
    return right[kept], scaled.T @ b, scaled


def _normalised(qp: Dense, back: Array) -> tuple[Array, Array, Array]:
    """Rows of length one for G and the bounds; ``0 v <= 1`` for one without a side."""
    rows, sides = [qp.G @ back], [qp.h]
    if np.isfinite(qp.lb).any() or np.isfinite(qp.ub).any():
        rows += [back, -back]
        sides += [qp.ub, -qp.lb]
    G, h = np.vstack(rows), np.concatenate(sides)
    lengths = np.linalg.norm(G, axis=1)
    lengths[lengths == 0.0] = 1.0
    free = h == np.inf
    G, h = G / lengths[:, None], h / lengths
    G[free], h[free] = 0.0, 1.0
    return G, h, lengths


def _largest_singular(A: Array, G: Array, qp: Dense) -> float:
    """Of all rows; a bound's two are opposite and count once."""
    n, once = len(qp.q), len(qp.h)
    upper, lower = G[once : once + n], G[once + n :]
    bounds = np.where(np.abs(upper) > 0.0, upper, lower)
    rows = np.vstack([A, G[:once], bounds])
    return float(np.linalg.norm(rows, 2)) if rows.size else 0.0
