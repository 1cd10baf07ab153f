"""Timing of a path within velocity and acceleration limits: toppra, guarded.

Guards against what the retimer is known to do: waypoints that repeat are
dropped, the path is resampled before it is smoothed, path and time are scaled
to order one, rows stand at the retimer's own breakpoints, and what it returns
is believed only after the exact extremes of the delivered cubics were compared
with the limits (and time stretched where they exceed them).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from rrnn_opt.arguments import checked
from rrnn_opt.errors import RetimeError
from rrnn_opt.motion.limits import position_excess, require_limits, slow_down
from rrnn_opt.motion.parametrised import parametrised
from rrnn_opt.motion.path import Path
from rrnn_opt.motion.spline import SmoothPath
from rrnn_opt.motion.stop_and_go import SHORTEST, stop_and_go
from rrnn_opt.motion.trajectory import Trajectory

if TYPE_CHECKING:
    from rrnn_opt.robot import Limits


@checked()
@dataclass(frozen=True)
class RetimeSettings:
    """How finely a path is timed.

    Attributes:
        rows: least number of steps between rows.
        bent: steps of a span of the smoothed path that bends, for one of a
            straight span.
        max_stretch: a grid that needs a larger factor of time than this is refined.
        refinements: how often the grid may be doubled for that.
        overshoot: positions may leave the joint box by this, rad or m.
    """

    rows: int = 40
    bent: int = 3
    max_stretch: float = 1.05
    refinements: int = 2
    overshoot: float = 1e-10


@checked(skip=("limits",))
def retime(
    waypoints: ArrayLike,
    limits: Limits,
    *,
    spacing: float = 0.1,
    settings: RetimeSettings | None = None,
) -> Trajectory:
    """The fastest motion found along a smoothed path, within all limits.

    Args:
        waypoints: (N, nv), rad or m; collision-free straight lines between them.
        limits: position, velocity and acceleration limits.
        spacing: knot distance of the smoothed path, rad or m; corners are
            rounded within it.
        settings: fineness; defaults serve.

    Returns:
        Rows from rest to rest, the first exactly the start, the last exactly
        the goal.  A path that goes nowhere gives two rows 1 ms apart.

    Raises:
        NotFiniteError: a number is NaN or infinite.
        ShapeError: shapes do not fit.
        RetimeError: the retimer failed (its ``reason`` says how), or the
            waypoints leave the position limits.
    """
    chosen = RetimeSettings() if settings is None else settings
    path = Path(np.asarray(waypoints, dtype=np.float64)).without_duplicates()
    require_limits(limits, path.waypoints.shape[1])
    if not spacing > 0:
        raise RetimeError("the spacing must be positive", "bad spacing")
    if len(path.waypoints) == 1 or path.length < SHORTEST**2:
        return stop_and_go(path.waypoints, limits)
    trajectory = _timed(path, limits, spacing, chosen)
    if position_excess(trajectory, limits) > chosen.overshoot:
        message = "the timed path leaves the position limits"
        raise RetimeError(f"{message}; refine the spacing", "position limits")
    return trajectory


def _timed(
    path: Path, limits: Limits, spacing: float, settings: RetimeSettings
) -> Trajectory:
    """Best of the grids tried: finer ones only where a stretch is called for."""
    scale = 2.0 ** np.ceil(np.log2(path.length))  # a power of two: scales recur
    curve = SmoothPath(path, spacing=spacing, scale=scale)
    clock = float(np.sqrt(scale / np.min(limits.acceleration)))
    velocity = limits.velocity * clock / scale
    acceleration = limits.acceleration * clock**2 / scale
    best: Trajectory | None = None
    for k in range(settings.refinements + 1):
        grid = curve.grid(settings.rows * 2**k, settings.bent)
        t, speed = parametrised(curve, grid, velocity, acceleration)
        q, qd = curve(grid) * scale, curve(grid, 1) * speed[:, None] * scale / clock
        q[0], q[-1], qd[0], qd[-1] = path.start, path.goal, 0.0, 0.0
        raw = Trajectory.from_rows(t * clock, q, qd)
        found = slow_down(raw, limits)
        if best is None or found.duration < best.duration:
            best = found
        if found.duration <= settings.max_stretch * raw.duration:
            break
    assert best is not None  # the loop runs once at least
    return best
