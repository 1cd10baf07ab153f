"""Of which kind a value is: whether it is what a type says."""

from __future__ import annotations

import numbers
import types
import typing
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

Test = Callable[[Any], bool]
SEVERAL = (tuple, list, Sequence, Iterable)
_LOOKED = 10_000


def accepts(hint: Any) -> Test:
    """Whether a value is of the kind that a type says; others pass."""
    origin, within = typing.get_origin(hint), typing.get_args(hint)
    if hint in PLAIN:
        return PLAIN[hint]
    if origin in (typing.Union, types.UnionType):
        tests = [accepts(part) for part in within]
        return lambda value: any(test(value) for test in tests)
    if origin is typing.Literal:
        return lambda value: isinstance(value, str) and value in within
    if origin is np.ndarray:
        return is_numeric
    if origin in SEVERAL:
        return _several(origin, within)
    if origin is Mapping or origin is dict:
        return lambda value: isinstance(value, Mapping)
    if origin is Callable or hint is Callable:
        return callable
    kind = origin or hint
    if kind is Any:
        return lambda value: True
    if isinstance(kind, type) and not getattr(kind, "_is_protocol", False):
        return lambda value: isinstance(value, kind)
    return lambda value: True


def _several(origin: Any, within: tuple[Any, ...]) -> Test:
    """Whether a value has entries, each of a kind; what is read but once is not."""
    part = accepts(within[0]) if within else lambda value: True
    open_kind = Iterable if origin is Iterable else Sequence

    def test(value: Any) -> bool:
        if isinstance(value, np.ndarray) and (value.ndim == 0 or value.size > _LOOKED):
            return bool(value.ndim)
        if isinstance(value, list | tuple | np.ndarray):
            return all(part(entry) for entry in value)
        return isinstance(value, open_kind) and not isinstance(
            value, str | bytes | memoryview | Mapping
        )

    return test


def is_real(value: Any) -> bool:
    """Whether a value is one number that a double can hold; NaN is one here."""
    if isinstance(value, bool | np.bool_) or not isinstance(value, numbers.Real):
        return False
    try:
        float(value)
    except OverflowError:
        return False
    return True


def is_whole(value: Any) -> bool:
    """Whether a value is a whole number and no truth value."""
    return isinstance(value, numbers.Integral) and not isinstance(value, bool)


def is_numeric(value: Any) -> bool:
    """Whether a value is an array of real numbers, or can be taken for one."""
    if isinstance(value, str | bytes | memoryview | Mapping | set):
        return False
    try:
        array = np.asarray(value)
    except (ValueError, TypeError, OverflowError, RecursionError):
        return False
    return array.dtype.kind in "iuf"


PLAIN: dict[Any, Test] = {
    float: is_real,
    int: is_whole,
    bool: lambda value: isinstance(value, bool | np.bool_),
    str: lambda value: isinstance(value, str),
    type(None): lambda value: value is None,
}
