"""Joint limits of a cubic motion, from its exact extremes."""

from __future__ import annotations

from typing import Any

import numpy as np

from rrnn_opt.check import hermite
from rrnn_opt.check.collision import PROVED, REFUTED, UNKNOWN
from rrnn_opt.check.hermite import Pieces
from rrnn_opt.check.model import Model
from rrnn_opt.check.reading import Array

TOLERANCE = 1e-9
"""Relative: a limit L counts as kept up to L + 1e-9 |L| (or 1e-9 below one)."""


def prove_limits(
    model: Model, t: Array, pieces: Pieces
) -> tuple[str, dict[str, Any] | None]:
    """Whether position, velocity and acceleration limits hold at all times.

    Args:
        model: the robot.
        t: times of the rows, (n,), s.
        pieces: cubics of the coordinates.

    Returns:
        Verdict, and {"kind", "coordinate", "time", "value", "limit"} of the
        first piece that breaks one (None when proved).
    """
    ranges = (
        ("position", hermite.position_range(pieces), model.lower, model.upper),
        ("velocity", hermite.velocity_range(pieces), -model.velocity, model.velocity),
        (
            "acceleration",
            hermite.acceleration_range(pieces),
            -model.acceleration,
            model.acceleration,
        ),
    )
    errors = hermite.rounding(pieces)
    verdict = PROVED
    for (kind, (low, high), least, most), error in zip(ranges, errors, strict=True):
        sides = ((least - low, least, low), (high - most, most, high))
        for excess, limit, value in sides:
            allowed = TOLERANCE * np.maximum(1.0, np.abs(limit))
            broken = excess - error > allowed
            if broken.any():
                piece, k = np.argwhere(broken)[0]
                return REFUTED, {
                    "kind": kind,
                    "coordinate": int(k),
                    "time": float(t[piece]),
                    "value": float(value[piece, k]),
                    "limit": float(limit[k]),
                }
            if not np.all(excess + error <= allowed):
                verdict = UNKNOWN
    return verdict, None
