"""Demands on single values, for what an annotation cannot say."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from rrnn_opt.arguments.kinds import is_numeric
from rrnn_opt.arguments.words import shown
from rrnn_opt.errors import ArgumentError, NotFiniteError


def require_numeric(value: Any, name: str) -> None:
    """Refuse what is no array of real numbers.

    Args:
        value: what was given.
        name: of the argument, for the message.

    Raises:
        ArgumentError: it is not.
    """
    if not is_numeric(value):
        raise ArgumentError(name, f"expected numbers, got {shown(value)}")


def require_parts(value: Any, name: str, parts: Sequence[str]) -> None:
    """Refuse an object that lacks what is asked of it.

    Args:
        value: what was given.
        name: of the argument, for the message.
        parts: attributes that it must have.

    Raises:
        ArgumentError: it does.
    """
    missing = [part for part in parts if not hasattr(value, part)]
    if missing:
        raise ArgumentError(name, f"{shown(value)} has no {', '.join(missing)}")


def require_finite(made: Any, infinite: Sequence[str]) -> None:
    """Every number that a dataclass keeps is finite, but where it is meant.

    Raises:
        NotFiniteError: one is not.
    """
    for name, field in made.__dataclass_fields__.items():
        value = getattr(made, name, None)
        if name in infinite or value is field.default:
            continue
        if isinstance(value, float | np.floating):
            sound = math.isfinite(value)
        elif isinstance(value, np.ndarray) and value.dtype.kind == "f":
            sound = bool(np.all(np.isfinite(value)))
        else:
            sound = True
        if not sound:
            raise NotFiniteError(f"{type(made).__name__}.{name}")
