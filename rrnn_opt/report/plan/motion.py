"""The motion that a plan result holds, sampled for drawing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

FRAMES = 80
MOST_FRAMES = 160
FRAMES_PER_SECOND = 16


@dataclass(frozen=True, eq=False)
class Motion:
    """Samples of a motion.

    Attributes:
        t: s, (n,); along an untimed path the share of its length, 0 to 1.
        q: positions, (n, nv), rad or m.
        qd: velocities, (n, nv), or None for a path without times.
    """

    t: Array
    q: Array
    qd: Array | None

    @property
    def moves(self) -> bool:
        """Whether there is more than one posture."""
        return len(self.t) > 1


def motion_of(document: dict[str, Any]) -> Motion:
    """Samples of what was delivered, else of the path, else the start.

    Args:
        document: plan result.

    Returns:
        ``FRAMES`` samples, up to ``MOST_FRAMES`` of a motion of many seconds.
    """
    trajectory = document.get("trajectory")
    if trajectory and trajectory.get("t"):
        begin, end = trajectory["t"][0], trajectory["t"][-1]
        wanted = np.clip(FRAMES_PER_SECOND * (end - begin), FRAMES, MOST_FRAMES)
        t = np.linspace(begin, end, int(wanted))
        return Motion(t, *sample(trajectory, t))
    path = np.atleast_2d(np.asarray(document.get("path") or [], dtype=float))
    if path.size and len(path) > 1:
        return _along(path, FRAMES)
    start = np.asarray(document["problem"]["start"], dtype=float)
    return Motion(np.zeros(1), start[None, :], None)


def sample(trajectory: dict[str, Any], times: Array) -> tuple[Array, Array]:
    """Delivered motion at some times: the cubic Hermite polynomials of its rows.

    With ``s`` the share of interval i that has passed, ``h`` its length,
    ``m = (q[i+1] - q[i]) / h``, ``a = qd[i]`` and ``b = qd[i+1]``:
    ``q = q[i] + h s (a + s (3 m - 2 a - b) + s^2 (a + b - 2 m))``.

    Args:
        trajectory: ``trajectory`` block of a plan result (t, q, qd).
        times: s, (n,), within the trajectory.

    Returns:
        Positions and velocities, each (n, nv).
    """
    t = np.asarray(trajectory["t"], dtype=float)
    q = np.asarray(trajectory["q"], dtype=float)
    qd = np.asarray(trajectory["qd"], dtype=float)
    if len(t) == 1:
        return np.repeat(q, len(times), axis=0), np.repeat(qd, len(times), axis=0)
    i = np.clip(np.searchsorted(t, times, side="right") - 1, 0, len(t) - 2)
    h = (t[i + 1] - t[i])[:, None]
    s = (times - t[i])[:, None] / h
    a, b, mean = qd[i], qd[i + 1], (q[i + 1] - q[i]) / h
    second, third = 3 * mean - 2 * a - b, a + b - 2 * mean
    position = q[i] + h * s * (a + s * (second + s * third))
    velocity = a + s * (2 * second + 3 * s * third)
    return position, velocity


def _along(path: Array, frames: int) -> Motion:
    """Straight segments between the waypoints, at equal steps of joint length."""
    lengths = np.linalg.norm(np.diff(path, axis=0), axis=1)
    knots = np.concatenate([[0.0], np.cumsum(lengths)])
    share = np.linspace(0.0, 1.0, frames)
    at = share * knots[-1]
    q = np.column_stack([np.interp(at, knots, column) for column in path.T])
    return Motion(share, q, None)
