"""Rotations: quaternion <-> matrix, and a frame around a normal.

Quaternions are ``(x, y, z, w)``; a matrix's columns are the axes of the body
in world coordinates.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

IDENTITY = (0.0, 0.0, 0.0, 1.0)
"""The quaternion of no rotation."""


def matrix_from_quaternion(quat_xyzw: ArrayLike) -> Array:
    """Rotation matrix of a quaternion, whatever its (non-zero) length.

    ``R = I + 2 (w [v]x + [v]x [v]x) / (v'v + w^2)``; dividing by the squared
    length makes R orthonormal to rounding even where q is only nearly unit.

    Args:
        quat_xyzw: (4,).

    Returns:
        (3, 3).
    """
    x, y, z, w = np.asarray(quat_xyzw, dtype=np.float64)
    s = 2.0 / (x * x + y * y + z * z + w * w)
    return np.array(
        [
            [1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)],
            [s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)],
            [s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)],
        ]
    )


def quaternion_from_matrix(rotation: ArrayLike) -> Array:
    """Unit quaternion of a rotation matrix, with w >= 0.

    Each row of the symmetric matrix ``4 q q'`` follows from the entries of R;
    the row of the largest component is taken, so nothing small is divided by.

    Args:
        rotation: (3, 3), orthonormal, determinant one.

    Returns:
        (4,), xyzw.
    """
    r = np.asarray(rotation, dtype=np.float64)
    trace = r[0, 0] + r[1, 1] + r[2, 2]
    squares = [1.0 + 2.0 * r[i, i] - trace for i in range(3)] + [1.0 + trace]
    best = int(np.argmax(squares))
    skew = np.array([r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1]])
    quat = np.empty(4)
    if best == 3:
        quat[:3] = skew
    else:
        quat[:3] = r[best] + r[:, best]
        quat[3] = skew[best]
    quat[best] = squares[best]
    quat /= np.linalg.norm(quat)
    return -quat if quat[3] < 0.0 else quat


def frame_around(normal: ArrayLike) -> Array:
    """A right-handed rotation whose third column is ``normal``.

    Args:
        normal: (3,), unit length.

    Returns:
        (3, 3); the third column is ``normal`` to the last bit.
    """
    n = np.asarray(normal, dtype=np.float64)
    helper = np.zeros(3)
    helper[int(np.argmin(np.abs(n)))] = 1.0
    first = np.cross(helper, n)
    first /= np.linalg.norm(first)
    return np.column_stack([first, np.cross(n, first), n])
