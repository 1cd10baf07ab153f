"""What a signature says of an argument, read once."""

from __future__ import annotations

import inspect
import sys
import types
import typing
from collections.abc import Callable
from typing import Any

from rrnn_opt.arguments.kinds import Test, is_numeric


def accepts_numbers(annotation: Any) -> Test | None:
    """What looks at "ArrayLike" or "Value", with or without None; else None."""
    words = annotation.split(" | ") if isinstance(annotation, str) else []
    if not {"ArrayLike", "Value"} & set(words):
        return None
    symbolic = "Value" in words

    def test(value: Any) -> bool:
        if value is None:
            return "None" in words
        return (symbolic and hasattr(value, "is_symbolic")) or is_numeric(value)

    return test


def hint_of(
    name: str, annotation: Any, function: Callable[..., Any], owner: type | None
) -> Any:
    """The annotation as a type; None where it cannot be known here."""
    if not isinstance(annotation, str):
        return None if annotation is inspect.Parameter.empty else annotation
    homes = [getattr(function, "__globals__", {})]
    if owner is not None:
        bases = [c for c in owner.__mro__ if name in inspect.get_annotations(c)]
        homes = [vars(sys.modules[c.__module__]) for c in bases]
    for home in homes:
        holder = types.SimpleNamespace(__annotations__={name: annotation})
        try:
            return typing.get_type_hints(holder, home)[name]
        except (NameError, TypeError, AttributeError):
            continue
    return None
