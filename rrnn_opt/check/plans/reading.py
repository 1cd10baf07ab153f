"""Reading numbers out of documents that may hold anything."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.errors import DocumentError

Array = NDArray[np.float64]
LARGEST = 1e9
"""Numbers beyond this are refused: metres and radians never need them."""


def literal(text: str) -> Any:
    """A Python literal, as in the header of an .npy file.

    Raises:
        ValueError: it is none.
    """
    try:
        return ast.literal_eval(text.strip())
    except (SyntaxError, ValueError):
        raise ValueError("no literal") from None


def mapping(value: Any, name: str) -> Mapping[str, Any]:
    """``value`` as a JSON object.

    Raises:
        DocumentError: it is something else.
    """
    if not isinstance(value, Mapping):
        raise DocumentError(name, "must be an object")
    return value


def get(owner: Mapping[str, Any], key: str, name: str) -> Any:
    """``owner[key]``, required.

    Raises:
        DocumentError: the key is missing.
    """
    if key not in owner:
        raise DocumentError(f"{name}.{key}" if name else key, "is missing")
    return owner[key]


def listing(value: Any, name: str) -> list[Any]:
    """``value`` as a list.

    Raises:
        DocumentError: it is not a list (or tuple).
    """
    if not isinstance(value, list | tuple):
        raise DocumentError(name, "must be a list")
    return list(value)


def text(value: Any, name: str) -> str:
    """``value`` as a string.

    Raises:
        DocumentError: it is not one.
    """
    if not isinstance(value, str):
        raise DocumentError(name, "must be a string")
    return value


def numbers(value: Any, shape: tuple[int | None, ...], name: str) -> Array:
    """``value`` as finite numbers of the wanted shape (None: any length).

    Raises:
        DocumentError: not numbers, wrong shape, not finite, or beyond 1e9.
    """
    try:
        array = np.array(value)
    except (ValueError, TypeError, OverflowError):
        raise DocumentError(name, "must be rows of numbers of equal length") from None
    if array.size and array.dtype.kind not in "iuf":
        raise DocumentError(name, "must hold numbers only")
    if array.ndim != len(shape) or any(
        want is not None and want != got
        for want, got in zip(shape, array.shape, strict=True)
    ):
        wanted = " x ".join("n" if s is None else str(s) for s in shape) or "one number"
        raise DocumentError(name, f"must be {wanted}, is {array.shape}")
    result = array.astype(np.float64)
    if not np.all(np.abs(result) <= LARGEST):
        raise DocumentError(name, f"numbers must be finite and below {LARGEST:g}")
    return result


def number(value: Any, name: str) -> float:
    """``value`` as one finite number."""
    return float(numbers(value, (), name))


def positive(value: Any, name: str) -> float:
    """``value`` as one number > 0.

    Raises:
        DocumentError: it is not.
    """
    result = number(value, name)
    if result <= 0:
        raise DocumentError(name, "must be positive")
    return result


def indices(value: Any, n: int, low: int, high: int, name: str) -> NDArray[np.int64]:
    """``n`` whole numbers in [low, high).

    Raises:
        DocumentError: they are not.
    """
    array = numbers(value, (n,), name)
    whole = array.astype(np.int64)
    if np.any(whole != array) or np.any(whole < low) or np.any(whole >= high):
        raise DocumentError(name, f"must be whole numbers from {low} to {high - 1}")
    return whole


def rotation(matrix: Array, name: str) -> Array:
    """``matrix`` (..., 3, 3) if it is a rotation within 1e-9.

    Raises:
        DocumentError: it is not.
    """
    gram = np.swapaxes(matrix, -1, -2) @ matrix
    proper = np.abs(gram - np.eye(3)) <= 1e-9
    if not (np.all(proper) and np.all(np.linalg.det(matrix) > 0)):
        raise DocumentError(name, "must be a rotation matrix")
    return matrix


def polished(rotation: Array) -> Array:
    """Rotations (..., 3, 3) brought to within 24 u of the nearest exact ones.

    One step of Newton and Schulz, ``R (3 I - R'R) / 2``: it turns a singular
    value 1 + e into 1 - 3 e^2 / 2 - .., and what is read has |e| < 1.5e-9.  Its
    own rounding is 9 u / 2 for R'R, 9 u for the product and 2 u for the rest.
    """
    gram = np.swapaxes(rotation, -1, -2) @ rotation
    step: Array = rotation @ ((3 * np.eye(3) - gram) / 2)
    return step


def pose(value: Any, name: str) -> tuple[Array, Array]:
    """A 4 x 4 homogeneous matrix as (rotation, translation).

    Raises:
        DocumentError: it is not one.
    """
    matrix = numbers(value, (4, 4), name)
    if np.any(matrix[3] != (0.0, 0.0, 0.0, 1.0)):
        raise DocumentError(name, "last row must be 0 0 0 1")
    return rotation(matrix[:3, :3], name), matrix[:3, 3]


def quaternion(value: Any, name: str) -> Array:
    """A unit quaternion (x, y, z, w) as a rotation matrix.

    Raises:
        DocumentError: its length is not one within 1e-6.
    """
    q = numbers(value, (4,), name)
    length = float(np.sqrt(q @ q))
    if abs(length - 1.0) > 1e-6:
        raise DocumentError(name, "must be of unit length")
    x, y, z, w = q / length
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
