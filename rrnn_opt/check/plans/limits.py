"""Joint limits of a cubic motion, from its exact extremes.

Doubles settle what they can settle beyond their own rounding; what is left is
decided in rational arithmetic (:mod:`~rrnn_opt.check.arithmetic.cubic`), so no
limit stays open.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from rrnn_opt.check.arithmetic import cubic
from rrnn_opt.check.plans import hermite
from rrnn_opt.check.plans.collision.proof import PROVED, REFUTED
from rrnn_opt.check.plans.motion import Motion
from rrnn_opt.check.plans.reading import Array
from rrnn_opt.check.plans.robot.model import Model

TOLERANCE = 1e-9
"""Relative: a limit L counts as kept up to L + 1e-9 |L| (or 1e-9 below one)."""


class _Side(NamedTuple):
    """One side of one kind of limit: ``value`` must not exceed ``limit``.

    Attributes:
        kind: "position", "velocity" or "acceleration".
        sign: 1, or -1 where all is mirrored to make a lower limit an upper one.
        value: greatest on each piece, (n - 1, nv).
        limit: (nv,).
        error: rounding of the value, (n - 1, nv).
    """

    kind: str
    sign: int
    value: Array
    limit: Array
    error: Array


def prove_limits(
    model: Model, motion: Motion, *, exact: bool = False
) -> tuple[str, dict[str, Any] | None]:
    """Whether position, velocity and acceleration limits hold at all times.

    Args:
        model: the robot.
        motion: rows and cubics.
        exact: leave nothing to doubles.

    Returns:
        Verdict, and {"kind", "coordinate", "time", "value", "limit"} of the
        first piece that breaks one (None when proved).
    """
    for side in _sides(model, motion):
        allowed = side.limit + TOLERANCE * np.maximum(1.0, np.abs(side.limit))
        error = side.error + 1e-15 * np.abs(allowed)
        kept = (side.value + error <= allowed) & (not exact) | np.isinf(side.limit)
        for piece, k in np.argwhere(~kept):
            if _broken(side, motion, int(piece), int(k), float(allowed[k])):
                return REFUTED, _witness(side, motion, int(piece), int(k))
    return PROVED, None


def _sides(model: Model, motion: Motion) -> list[_Side]:
    p = motion.pieces
    position, velocity, acceleration = hermite.rounding(p)
    sides = []
    for kind, (low, high), least, most, error in (
        ("position", hermite.position_range(p), model.lower, model.upper, position),
        (
            "velocity",
            hermite.velocity_range(p),
            -model.velocity,
            model.velocity,
            velocity,
        ),
        (
            "acceleration",
            hermite.acceleration_range(p),
            -model.acceleration,
            model.acceleration,
            acceleration,
        ),
    ):
        sides.append(_Side(kind, -1, -low, -least, error))
        sides.append(_Side(kind, 1, high, most, error))
    return sides


def _broken(side: _Side, motion: Motion, piece: int, k: int, allowed: float) -> bool:
    rows = slice(piece, piece + 2)
    t = motion.t[rows].tolist()
    q, qd = (side.sign * motion.q[rows, k]).tolist(), side.sign * motion.qd[rows, k]
    return not cubic.keeps(side.kind, t, q, qd.tolist(), allowed)


def _witness(side: _Side, motion: Motion, piece: int, k: int) -> dict[str, Any]:
    return {
        "kind": side.kind,
        "coordinate": k,
        "time": float(motion.t[piece]),
        "value": side.sign * float(side.value[piece, k]),
        "limit": side.sign * float(side.limit[k]),
    }
