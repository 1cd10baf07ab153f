"""Postures to compare solvers at: anywhere, near limits, near singularities."""

from __future__ import annotations

from functools import cached_property

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from rrnn_opt.robot import Kinematics

Array = NDArray[np.float64]

WIDE = 2.0
"""Half of the range that stands for a joint without limits, rad or m."""

_DRAWS = 100
_ROUNDS = 3


class Postures:
    """Random postures of one robot, within its limits.

    Args:
        kin: kinematics of the robot.
    """

    def __init__(self, kin: Kinematics) -> None:
        limits = kin.robot.limits
        self._kin = kin
        self.lower = np.where(np.isfinite(limits.lower), limits.lower, -WIDE)
        self.upper = np.where(np.isfinite(limits.upper), limits.upper, WIDE)

    def inside(self, rng: np.random.Generator) -> Array:
        """Every joint between 15 and 85 % of its range, (nv,)."""
        return self._at(rng.uniform(0.15, 0.85, self.lower.size))

    def near_limits(self, rng: np.random.Generator) -> Array:
        """Each joint with probability 1/2 within 5 % of one of its limits, (nv,)."""
        share = rng.uniform(0.1, 0.9, self.lower.size)
        close = 0.05 * rng.uniform(size=share.size) ** 2
        edge = np.where(rng.random(share.size) < 0.5, close, 1.0 - close)
        return self._at(np.where(rng.random(share.size) < 0.5, edge, share))

    def near_singularity(self, rng: np.random.Generator) -> Array:
        """A small least singular value of the tip's Jacobian, by random descent."""
        first = np.array([self.inside(rng) for _ in range(_DRAWS)])
        best: Array = first[np.argmin(self._least(first))]
        radius = 0.2 * (self.upper - self.lower)
        for _ in range(_ROUNDS):
            radius = 0.2 * radius
            around = best + radius * rng.uniform(-1.0, 1.0, (_DRAWS, best.size))
            around = np.clip(around, self.lower, self.upper)
            best = around[np.argmin(self._least(around))]
        return best

    def _at(self, share: Array) -> Array:
        q: Array = self.lower + (self.upper - self.lower) * share
        return q

    def _least(self, postures: Array) -> Array:
        """Least singular value of J, rows that never move left out, (k,)."""
        stacked = np.asarray(self._jacobians(postures.T))
        n = postures.shape[1]
        each = stacked.reshape(len(stacked), len(postures), n).transpose(1, 0, 2)
        return np.asarray(np.linalg.svd(each, compute_uv=False)[:, -1], dtype=float)

    @cached_property
    def _jacobians(self) -> ca.Function:
        """(nv, k) postures to their Jacobians side by side."""
        J = self._kin.jacobian()
        moving = [i for i in range(3) if not J[i, :].is_zero()]
        one = ca.Function("J", [self._kin.q], [ca.densify(J[moving, :])])
        return one.map(_DRAWS)
