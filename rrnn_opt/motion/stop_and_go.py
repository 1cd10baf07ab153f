"""The last resort: along the polyline itself, at rest at every corner."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from rrnn_opt.arguments import checked
from rrnn_opt.motion.limits import ROOM, require_limits
from rrnn_opt.motion.path import Path
from rrnn_opt.motion.trajectory import Trajectory

if TYPE_CHECKING:
    from rrnn_opt.robot import Limits

SHORTEST = 1e-3
"""Least duration of a piece, s; that of a motion that goes nowhere."""


@checked(skip=("limits",))
def stop_and_go(waypoints: ArrayLike, limits: Limits) -> Trajectory:
    """Rest at every waypoint, straight lines between them.

    With zero velocities at both rows the cubic Hermite is
    ``q0 + (3 s^2 - 2 s^3)(q1 - q0)``: it runs along the straight line exactly,
    so what was proved of the polyline carries over.  Its largest velocity is
    1.5 |q1 - q0| / T, its largest acceleration 6 |q1 - q0| / T^2, hence the
    shortest T of each piece in closed form.

    Args:
        waypoints: (N, nv), rad or m; one row, or equal rows, give two equal
            rows 1 ms apart.
        limits: joint limits; position limits hold when the waypoints keep them.

    Raises:
        NotFiniteError, ShapeError, RetimeError: malformed input.
    """
    path = Path(np.asarray(waypoints, dtype=np.float64)).without_duplicates()
    require_limits(limits, path.waypoints.shape[1])
    points = path.waypoints
    if len(points) == 1:
        points = np.repeat(points, 2, axis=0)
    step = np.abs(np.diff(points, axis=0))
    cruise = (1.5 * step / limits.velocity).max(axis=1)
    push = np.sqrt(6 * step / limits.acceleration).max(axis=1)
    pieces = np.maximum(np.maximum(cruise, push) * (1 + ROOM), SHORTEST)
    t = np.concatenate([[0.0], np.cumsum(pieces)])
    return Trajectory.from_rows(t, points, np.zeros_like(points))
