"""Checks of single fields: what a user wrote becomes numbers, or one sentence.

Every function takes the value and the name of its field and returns the
checked value or raises ``ProblemError`` with that name.  Booleans are not
numbers here, and NaN, infinities and astronomic numbers are refused.
"""

from __future__ import annotations

import difflib
import math
from collections.abc import Collection, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.errors import ProblemError

Array = NDArray[np.float64]

LARGEST = 1e6
"""Largest magnitude accepted for lengths and angles, m or rad: beyond it a
double resolves no better than 1e-10 m."""

UNIT_SLACK = 1e-3
"""A direction or quaternion this close to unit length is normalised."""

_NORMALISED = 1e-14
_QUATERNION = 4
_SHOWN = 40


def shown(value: object, limit: int = _SHOWN) -> str:
    """``value`` as it appears in a message: one line of ``limit`` characters."""
    if isinstance(value, dict | list | tuple):
        return f"a {type(value).__name__} of {len(value)}"
    try:
        text = " ".join(repr(value).split())
    except (ValueError, RecursionError):  # integers of thousands of digits
        text = f"a huge {type(value).__name__}"
    return text if len(text) <= limit else text[: limit - 3] + "..."


def number(value: object, field: str) -> float:
    """A finite real number of magnitude at most ``LARGEST``.

    Raises:
        ProblemError: it is anything else.
    """
    real = isinstance(value, int | float | np.integer | np.floating)
    if not real or isinstance(value, bool):
        raise ProblemError(field, f"expected a number, got {shown(value)}")
    try:
        result = float(value)  # type: ignore[arg-type]
    except OverflowError:
        result = math.inf
    if not math.isfinite(result):
        raise ProblemError(field, f"expected a finite number, got {shown(value)}")
    if abs(result) > LARGEST:
        raise ProblemError(field, f"{result:g} is too large, at most {LARGEST:g}")
    return result


def positive(value: object, field: str) -> float:
    """A number greater than zero.

    Raises:
        ProblemError: it is not.
    """
    result = number(value, field)
    if result <= 0.0:
        raise ProblemError(field, f"must be greater than zero, got {result:g}")
    return result


def not_negative(value: object, field: str) -> float:
    """A number that is zero or greater.

    Raises:
        ProblemError: it is not.
    """
    result = number(value, field)
    if result < 0.0:
        raise ProblemError(field, f"must not be negative, got {result:g}")
    return result


def vector(value: object, length: int | None, field: str) -> Array:
    """A read-only vector of ``length`` finite numbers (None: any length).

    Raises:
        ProblemError: it is not a list of that many numbers.
    """
    if isinstance(value, np.ndarray) and value.ndim == 1:
        value = list(value)
    if not isinstance(value, list | tuple):
        count = "" if length is None else f"{length} "
        message = f"expected a list of {count}numbers, got {shown(value)}"
        raise ProblemError(field, message)
    if length is not None and len(value) != length:
        raise ProblemError(field, f"expected {length} numbers, got {len(value)}")
    array = np.array([number(v, f"{field}[{i}]") for i, v in enumerate(value)])
    array.flags.writeable = False
    return array


def sizes(value: object, length: int, field: str) -> Array:
    """A read-only vector of ``length`` numbers greater than zero.

    Raises:
        ProblemError: it is not.
    """
    array = vector(value, length, field)
    for i, entry in enumerate(array):
        positive(entry, f"{field}[{i}]")
    return array


def unit(value: object, length: int, field: str) -> tuple[Array, float]:
    """A vector of unit length, and the length that was given.

    Off by less than ``UNIT_SLACK`` it is normalised.

    Raises:
        ProblemError: it is zero, or further from unit length.
    """
    array = vector(value, length, field)
    norm = float(np.linalg.norm(array))
    if not abs(norm - 1.0) < UNIT_SLACK:
        remedy = "" if norm == 0.0 else f"; divide it by {norm:.6g}"
        order = ", its order is x, y, z, w" if length == _QUATERNION else ""
        message = f"must have unit length, has {norm:.6g}{remedy}{order}"
        raise ProblemError(field, message)
    if abs(norm - 1.0) <= _NORMALISED:
        return array, 1.0
    array = array / norm
    array.flags.writeable = False
    return array, norm


def text(value: object, field: str) -> str:
    """A printable string that is not empty.

    Raises:
        ProblemError: it is not.
    """
    if not isinstance(value, str):
        raise ProblemError(field, f"expected a text, got {shown(value)}")
    if not value.strip() or not value.isprintable():
        raise ProblemError(field, f"must be one printable line, got {shown(value)}")
    return value


def record(
    value: object,
    field: str,
    *,
    required: Collection[str],
    optional: Collection[str] = (),
) -> dict[str, Any]:
    """A mapping with exactly the expected keys.

    Args:
        value: what was given.
        field: its name; "" for the whole document.
        required: keys that must be there.
        optional: keys that may be there.

    Returns:
        The mapping as a dict.

    Raises:
        ProblemError: it is no mapping, a key is missing, or a key is unknown
            (the closest known name is suggested).
    """
    if not isinstance(value, Mapping):
        raise ProblemError(
            field or "problem", f"expected an object, got {shown(value)}"
        )
    known = [*required, *optional]
    for key in value:
        if key not in known:
            message = f"is not a known field; {suggestion(key, known)}"
            raise ProblemError(join(field, key), message)
    for key in required:
        if key not in value:
            raise ProblemError(join(field, key), "is missing")
    return dict(value)


def join(field: str, key: object) -> str:
    """Name of the entry ``key`` of ``field``."""
    name = shown(key)
    if isinstance(key, str) and key.isprintable() and 0 < len(key) <= _SHOWN:
        name = key
    return f"{field}.{name}" if field else name


def suggestion(word: object, known: Collection[str]) -> str:
    """The known name closest to ``word``, or all of them, for a message."""
    name = word[:_SHOWN] if isinstance(word, str) else shown(word)
    close = difflib.get_close_matches(name, known, n=1)
    return f"did you mean '{close[0]}'?" if close else "known: " + ", ".join(known)
