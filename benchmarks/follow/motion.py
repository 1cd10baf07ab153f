"""The delivered cubic between its rows: places, rates and their bounds."""

from __future__ import annotations

from typing import Any

import numpy as np


def postures(
    t: np.ndarray, q: np.ndarray, qd: np.ndarray, times: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Positions and velocities of the delivered cubic at N times, (N, nv) each."""
    i = np.clip(np.searchsorted(t, times, side="right") - 1, 0, len(t) - 2)
    h = (t[i + 1] - t[i])[:, None]
    x = (times - t[i])[:, None] / h
    a, b, mean = qd[i], qd[i + 1], (q[i + 1] - q[i]) / h
    second, third = 3 * mean - 2 * a - b, a + b - 2 * mean
    place = q[i] + h * x * (a + x * (second + x * third))
    return place, a + x * (2 * second + 3 * x * third)


def joint_bounds(
    t: np.ndarray, q: np.ndarray, qd: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Largest joint speeds and accelerations between the rows, (rows - 1, nv) each.

    Speeds are bounded by the Bezier ordinates of the quadratic; accelerations are
    linear, so their ends bound them.
    """
    h = np.diff(t)[:, None]
    mean, a, b = np.diff(q, axis=0) / h, qd[:-1], qd[1:]
    inner = 3.0 * mean - a - b
    rates = np.max(np.abs([a, inner, b]), axis=0)
    ends = np.abs([6 * mean - 4 * a - 2 * b, 2 * a + 4 * b - 6 * mean]) / h
    return rates, ends.max(axis=0)


def beyond_limits(
    limits: dict[str, Any], t: np.ndarray, q: np.ndarray, qd: np.ndarray
) -> float:
    """Largest excess over the limits between the rows; see ``Followed``."""
    bounds = {
        key: np.array([np.nan if v is None else v for v in limits[key]], float)
        for key in ("lower", "upper", "velocity", "acceleration")
    }
    h = np.diff(t)[:, None]
    mean = np.diff(q, axis=0) / h
    second, third = 3 * mean - 2 * qd[:-1] - qd[1:], qd[:-1] + qd[1:] - 2 * mean
    fine = np.linspace(0.0, 1.0, 9)[:, None, None]
    place = q[:-1] + h * fine * (qd[:-1] + fine * (second + fine * third))
    speed = qd[:-1] + fine * (2 * second + 3 * fine * third)
    rate = np.stack([2 * second, 2 * second + 6 * third]) / h
    off = [
        np.fmax(bounds["lower"] - place, place - bounds["upper"]),
        np.abs(speed) / bounds["velocity"] - 1.0,
        np.abs(rate) / bounds["acceleration"] - 1.0,
    ]
    return max(0.0, *(float(np.nanmax(part, initial=0.0)) for part in off))
