"""Certain lower bounds of the smallest singular value of J over boxes.

Over a box with centre c and half-widths w, let V be (nearly) the eigenvectors
of G(c), G = J J'.  By the mean value theorem, entry by entry,

    |V' (G(q) - G(c)) V| <= R,    R = sum_k w_k max |V' dG/dq_k V|,

and by Weyl's inequality in the form for comparison matrices (Perron),

    lambda_min(V' G(q) V) >= min_i (C x)_i / x_i      for every x > 0,

C having the diagonal M_ii - R_ii and -(|M_ij| + R_ij) elsewhere, M = V' G(c) V.
With |V' V - I| <= phi this bounds sigma_min(J(q))^2 after division by 1 + phi.
In the eigenbasis the bound loses the true slope of the eigenvalue only, where
sigma_min(J(c)) - |Delta J| loses that of the whole matrix.

Enclosures come from the outward-rounded kernels; what floating point adds here
is covered by slacks: every sum below passes through fewer than 100 roundings,
1e-14 of the sum of absolute values, and 1e-13 of it is taken off.
"""

from __future__ import annotations

from dataclasses import dataclass

import casadi as ca
import numpy as np

from rrnn_opt.verification.engines.interval.forms import half_widths, middle
from rrnn_opt.verification.engines.interval.kernel import (
    Array,
    Enclosure,
    IntervalKernel,
)
from rrnn_opt.verification.region.reduced import FRAME, ReducedArm

_SLACK = 1e-13


@dataclass(frozen=True, eq=False)
class Bound:
    """What is known of B boxes.

    Attributes:
        least: sigma_min(J) >= least all over the box, (B,); 0 where unknown.
        centre: sigma_min(J) in the middle, floating point only, (B,).
        spread: how much each joint loosens the bound, (k, B).
    """

    least: Array
    centre: Array
    spread: Array


@dataclass(frozen=True, eq=False)
class SingularBound:
    """Kernels of G = J J' and of its slopes; made by :meth:`of`.

    Attributes:
        rows: size of G.
        value: upper triangle of G, over points.
        slope: its derivative by each joint in turn, over boxes.
    """

    rows: int
    value: IntervalKernel
    slope: IntervalKernel

    @staticmethod
    def of(arm: ReducedArm) -> SingularBound:
        """Compile the kernels.

        Raises:
            UnsupportedOperationError: intervals cannot do an operation of J.
        """
        G = arm.J @ arm.J.T
        n = G.shape[0]
        entries = ca.vertcat(*[G[i, j] for i in range(n) for j in range(i, n)])
        slope = ca.densify(ca.jacobian(entries, arm.q))
        return SingularBound(
            n,
            IntervalKernel.of(ca.Function("gram", [arm.q], [entries])),
            IntervalKernel.of(ca.Function("slope", [arm.q], [slope])),
        )

    def __call__(self, lower: Array, upper: Array) -> Bound:
        """Bound sigma_min over boxes, (k, B) each."""
        centre = middle(lower, upper)
        half = half_widths(lower, upper, centre)
        at, slope = self.value(centre, centre), self.slope(lower, upper)
        known = at.bounded & slope.bounded
        G, radius = self._matrices(at, 1)
        S, width = self._matrices(slope, len(half))
        G, radius = G[0], radius[0]
        values, V = np.linalg.eigh(np.where(known, G, 0.0).transpose(2, 0, 1))
        V = np.ascontiguousarray(V.transpose(1, 2, 0))
        M = _turned(V, G)
        size = _SLACK * np.sqrt(np.sum(G * G, axis=(0, 1))) * self.rows
        R = np.abs(_turned(V, S)) + _turned(np.abs(V), width + _SLACK * np.abs(S))
        parts = R * half[:, None, None]
        total = parts.sum(axis=0) * (1 + _SLACK) + _turned(np.abs(V), radius) + size
        least, x = _perron(M, total)
        spread = np.einsum("ib,kijb,jb->kb", x, parts, x)
        phi = _defect(V)
        good = known & np.isfinite(least) & (least > 0.0) & (phi < 1e-6)
        square = np.where(good, least, 0.0) / (1.0 + phi)
        bound = np.sqrt(square) * (1.0 - _SLACK) * FRAME
        exact = np.sqrt(np.maximum(values[:, 0], 0.0))
        return Bound(bound, exact, np.where(known, spread, half))

    def _matrices(self, enclosure: Enclosure, count: int) -> tuple[Array, Array]:
        """Middles and radii as symmetric matrices, (count, n, n, B)."""
        n, boxes = self.rows, enclosure.lower.shape[1]
        middles = 0.5 * (enclosure.lower + enclosure.upper)
        radii = np.maximum(enclosure.upper - middles, middles - enclosure.lower)
        index = np.zeros((n, n), int)
        index[np.triu_indices(n)] = np.arange(n * (n + 1) // 2)
        index = np.maximum(index, index.T)
        shape = (count, n * (n + 1) // 2, boxes)
        first: Array = middles.reshape(shape)[:, index]
        second: Array = radii.reshape(shape)[:, index] * (1 + _SLACK)
        return first, second


def _turned(V: Array, A: Array) -> Array:
    """V' A V for matrices in the leading axes and boxes in the last one."""
    half = np.einsum("aib,...acb->...icb", V, A)
    turned: Array = np.einsum("...icb,cjb->...ijb", half, V)
    return turned


def _defect(V: Array) -> Array:
    """No less than the norm of V'V - I."""
    E = np.einsum("aib,ajb->ijb", V, V) - np.eye(len(V))[:, :, None]
    norm: Array = np.sqrt(np.sum(E * E, axis=(0, 1))) * (1 + 1e-9) + _SLACK
    return norm


def _perron(M: Array, R: Array) -> tuple[Array, Array]:
    """Lower bound of the least eigenvalue of M + [-R, R], and the vector used."""
    n = len(M)
    diagonal = np.array([M[i, i] - R[i, i] for i in range(n)])
    off = np.abs(M) + R
    for i in range(n):
        off[i, i] = 0.0
    size = np.abs(diagonal) + off.sum(axis=1)
    best = np.min(diagonal - off.sum(axis=1) - _SLACK * size, axis=0)
    vector = np.ones_like(diagonal)
    x = vector
    with np.errstate(all="ignore"):
        guess = diagonal[0] - np.sum(off[0, 1:] ** 2 / (diagonal[1:] - diagonal[0]), 0)
        for _ in range(3):
            gap = np.maximum(diagonal[1:] - guess, 1e-9)
            rest = np.einsum("ijb,jb->ib", off, x)[1:]
            x = np.vstack([np.ones_like(guess)[None], np.clip(rest / gap, 1e-6, 1.0)])
            loss = np.einsum("ijb,jb->ib", off, x) / x
            rows = diagonal - loss * (1 + _SLACK) - _SLACK * np.abs(diagonal)
            found = np.min(rows, axis=0)
            better = found > best
            best = np.where(better, found, best)
            vector = np.where(better, x, vector)
            guess = np.where(np.isfinite(best), best, guess)
    return best, vector
