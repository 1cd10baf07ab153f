"""Rotations and poses as expressions."""

from __future__ import annotations

import casadi as ca
import numpy as np

from rrnn_opt.robot.tree import Array


def rotation_about(axis: Array, angle: ca.SX) -> ca.SX:
    """Rodrigues' rotation about a unit axis, ``R = c I + (1 - c) a a' + s [a]x``.

    Args:
        axis: a, (3,), of unit length.
        angle: with cosine c and sine s, rad.

    Returns:
        R, (3, 3); columns are the turned axes.
    """
    c, s = ca.cos(angle), ca.sin(angle)
    a = [float(value) for value in axis]
    out = ca.SX.zeros(3, 3)
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        out[i, i] = 1.0 if abs(a[i]) == 1.0 else c + (1 - c) * (a[i] * a[i])
        out[i, j] = (1 - c) * (a[i] * a[j]) - s * a[k]
        out[j, i] = (1 - c) * (a[i] * a[j]) + s * a[k]
    return out


def homogeneous(R: ca.SX, p: ca.SX) -> ca.SX:
    """The pose ``T = [R p; 0 1]``, (4, 4)."""
    bottom = ca.SX(np.array([[0.0, 0.0, 0.0, 1.0]]))
    return ca.densify(ca.vertcat(ca.horzcat(R, p), bottom))
