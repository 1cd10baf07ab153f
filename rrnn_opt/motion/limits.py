"""How much a trajectory exceeds joint limits, from its exact extremes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from rrnn_opt.arguments import require_parts
from rrnn_opt.check.plans import hermite
from rrnn_opt.errors import NotFiniteError, RetimeError, ShapeError
from rrnn_opt.motion.trajectory import Array, Trajectory

if TYPE_CHECKING:
    from rrnn_opt.robot import Limits

ROOM = 1e-7
"""Relative room that a stretch leaves below the limits, for rounding."""


def require_limits(limits: Limits, nv: int) -> None:
    """Refuse limits that no motion can be timed with.

    Raises:
        ShapeError: not one number a coordinate.
        NotFiniteError: a velocity or acceleration limit is NaN or infinite.
        RetimeError: one is not positive.
    """
    require_parts(limits, "limits", ("lower", "upper", "velocity", "acceleration"))
    for name in ("lower", "upper", "velocity", "acceleration"):
        values = np.asarray(getattr(limits, name))
        if values.shape != (nv,):
            raise ShapeError(f"limits.{name}", (nv,), values.shape)
    for name in ("velocity", "acceleration"):
        values = np.asarray(getattr(limits, name))
        if not np.all(np.isfinite(values)):
            raise NotFiniteError(f"limits.{name}")
        if np.any(values <= 0):
            raise RetimeError(f"limits.{name} must be positive", "bad limits")


def _worst(low: Array, high: Array, limit: Array) -> float:
    return float((np.maximum(np.abs(low), np.abs(high)) / limit).max())


def slow_down(trajectory: Trajectory, limits: Limits) -> Trajectory:
    """The trajectory, stretched until its exact extremes keep the limits.

    Velocity goes with 1 / factor, acceleration with 1 / factor^2.
    """
    p = trajectory.pieces
    speed = _worst(*hermite.velocity_range(p), limits.velocity)
    push = _worst(*hermite.acceleration_range(p), limits.acceleration)
    factor = max(speed, float(np.sqrt(push))) * (1 + ROOM)
    return trajectory if factor <= 1.0 else trajectory.stretched(factor)


def position_excess(trajectory: Trajectory, limits: Limits) -> float:
    """How far positions leave the joint box at most, rad or m (<= 0: nowhere)."""
    low, high = hermite.position_range(trajectory.pieces)
    return float(np.maximum(limits.lower - low, high - limits.upper).max())
