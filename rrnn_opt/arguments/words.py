"""Types and values in the words of a message."""

from __future__ import annotations

import types
import typing
from typing import Any

import numpy as np

from rrnn_opt.arguments.kinds import SEVERAL, accepts
from rrnn_opt.errors import ArgumentError

KINDS = {float: "a number", int: "a whole number", bool: "True or False"}
KINDS |= {str: "a text", type(None): "None"}


def part_of(hint: Any) -> Any:
    """The type of a sequence's entries; None where a type is no sequence."""
    within = typing.get_args(hint)
    return within[0] if typing.get_origin(hint) in SEVERAL and within else None


def refusal(where: str, value: Any, words: str, part: Any) -> ArgumentError:
    """What is wrong with a value: the first entry that is, where it is a sequence."""
    if part is not None and isinstance(value, list | tuple):
        sound = accepts(part)
        k = next((k for k, entry in enumerate(value) if not sound(entry)), 0)
        return refusal(f"{where}[{k}]", value[k], words_of(part), part_of(part))
    return ArgumentError(where, f"expected {words}, got {shown(value)}")


def words_of(hint: Any) -> str:
    """A type for people."""
    origin, within = typing.get_origin(hint), typing.get_args(hint)
    if hint in KINDS:
        return KINDS[hint]
    if origin in (typing.Union, types.UnionType):
        return " or ".join(dict.fromkeys(map(words_of, within)))
    if origin is typing.Literal:
        return "one of " + ", ".join(map(str, within))
    if origin is np.ndarray:
        return "an array of numbers"
    if origin in SEVERAL:
        return "a sequence"
    kind = origin or hint
    return f"a {getattr(kind, '__name__', 'value')}"


def shown(value: Any) -> str:
    """A value in a message: its kind, and itself where that is short."""
    kind = type(value).__name__
    if isinstance(value, np.ndarray):
        return f"an array of {value.dtype} {value.shape}"
    if isinstance(value, str | int | float | bool | complex | None):
        try:
            text = ascii(value)
        except ValueError:  # an integer of thousands of digits
            return f"a huge {kind}"
        return text if len(text) <= 40 else text[:37] + "..."
    return f"a {kind}"
