"""Arguments are of the kind that a signature says, or one sentence says which not.

``@checked`` stands on the constructors and verbs that users call.  It reads the
annotations once and looks at the kind alone: a number, a whole number, a text,
rows of numbers, an object of a class.  What values mean is for those who take
them; but no number that a checked dataclass keeps is NaN, nor infinite unless
its default is or it is named.
"""

from __future__ import annotations

import functools
import inspect
import math
import numbers
import sys
import types
import typing
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, TypeVar

import numpy as np

from rrnn_opt.errors import ArgumentError, NotFiniteError

Checked = TypeVar("Checked", bound=Callable[..., Any])
Test = Callable[[Any], bool]
_LOOKED = 10_000
_SEVERAL = (tuple, list, Sequence, Iterable)
_REST = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)


def checked(
    *, skip: Sequence[str] = (), infinite: Sequence[str] = ()
) -> Callable[[Checked], Checked]:
    """A decorator for a function or a dataclass that takes what users write.

    Args:
        skip: arguments that may be of other kinds than the annotation says.
        infinite: fields of a dataclass whose numbers may be infinite.

    Returns:
        The decorator.

    Raises:
        ArgumentError: when what it decorates is called: an argument is of another
            kind than its annotation says.
        NotFiniteError: likewise: a field of the dataclass is not finite.
    """

    def decorate(target: Checked) -> Checked:
        if isinstance(target, type):
            make = target.__init__  # type: ignore[misc]
            guard = _guarded(make, target, skip)

            @functools.wraps(make)
            def init(self: Any, *args: Any, **given: Any) -> None:
                guard(target.__name__, (self, *args), given)
                make(self, *args, **given)
                _require_finite(self, infinite)

            target.__init__ = init  # type: ignore[misc]
            return target
        guard = _guarded(target, None, skip)

        @functools.wraps(target)
        def call(*args: Any, **given: Any) -> Any:
            guard(target.__name__, args, given)
            return target(*args, **given)

        return typing.cast(Checked, call)

    return decorate


def _guarded(
    function: Callable[..., Any], owner: type | None, skip: Sequence[str]
) -> Callable[[str, tuple[Any, ...], dict[str, Any]], None]:
    """What looks at the arguments of a call; it reads annotations when first used."""

    @functools.cache
    def read() -> tuple[inspect.Signature, dict[str, tuple[Test, str, Any]]]:
        signature, tests = inspect.signature(function), {}
        for name, parameter in signature.parameters.items():
            if name in skip or parameter.kind in _REST:
                continue
            plain = _numeric(parameter.annotation)
            hint = _hint(name, parameter.annotation, function, owner)
            if plain is not None:
                tests[name] = (plain, "an array of numbers", None)
            elif hint is not None:
                tests[name] = (_test(hint), _words(hint), _part(hint))
        return signature, tests

    def guard(where: str, args: tuple[Any, ...], given: dict[str, Any]) -> None:
        signature, tests = read()
        try:
            bound = signature.bind(*args, **given).arguments
        except TypeError as error:
            raise ArgumentError(where, str(error)) from None
        for name, value in bound.items():
            if name in tests and not tests[name][0](value):
                raise _refusal(f"{where}: {name}", value, *tests[name][1:])

    return guard


def _part(hint: Any) -> Any:
    """The type of a sequence's entries; None where a type is no sequence."""
    within = typing.get_args(hint)
    return within[0] if typing.get_origin(hint) in _SEVERAL and within else None


def _refusal(where: str, value: Any, words: str, part: Any) -> ArgumentError:
    """What is wrong with a value: the first entry that is, where it is a sequence."""
    if part is not None and isinstance(value, list | tuple):
        sound = _test(part)
        k = next((k for k, entry in enumerate(value) if not sound(entry)), 0)
        return _refusal(f"{where}[{k}]", value[k], _words(part), _part(part))
    return ArgumentError(where, f"expected {words}, got {_shown(value)}")


def _numeric(annotation: Any) -> Test | None:
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


def _hint(
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


def _test(hint: Any) -> Test:
    """Whether a value is of the kind that a type says; others pass."""
    origin, within = typing.get_origin(hint), typing.get_args(hint)
    if hint in _PLAIN:
        return _PLAIN[hint]
    if origin in (typing.Union, types.UnionType):
        tests = [_test(part) for part in within]
        return lambda value: any(test(value) for test in tests)
    if origin is typing.Literal:
        return lambda value: isinstance(value, str) and value in within
    if origin is np.ndarray:
        return is_numeric
    if origin in _SEVERAL:
        return _several(within)
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


def _several(within: tuple[Any, ...]) -> Test:
    part = _test(within[0]) if within else lambda value: True

    def test(value: Any) -> bool:
        if isinstance(value, np.ndarray) and (value.ndim == 0 or value.size > _LOOKED):
            return bool(value.ndim)
        if isinstance(value, list | tuple | np.ndarray):
            return all(part(entry) for entry in value)
        return isinstance(value, Sequence) and not isinstance(value, str | bytes)

    return test


def require_numeric(value: Any, name: str) -> None:
    """Refuse what is no array of real numbers.

    Args:
        value: what was given.
        name: of the argument, for the message.

    Raises:
        ArgumentError: it is not.
    """
    if not is_numeric(value):
        raise ArgumentError(name, f"expected numbers, got {_shown(value)}")


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
        raise ArgumentError(name, f"{_shown(value)} has no {', '.join(missing)}")


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
    if isinstance(value, str | bytes | Mapping | set):
        return False
    try:
        array = np.asarray(value)
    except (ValueError, TypeError, OverflowError, RecursionError):
        return False
    return array.dtype.kind in "iuf"


_PLAIN: dict[Any, Test] = {
    float: is_real,
    int: is_whole,
    bool: lambda value: isinstance(value, bool | np.bool_),
    str: lambda value: isinstance(value, str),
    type(None): lambda value: value is None,
}
_KINDS = {float: "a number", int: "a whole number", bool: "True or False"}
_KINDS |= {str: "a text", type(None): "None"}


def _words(hint: Any) -> str:
    """A type for people."""
    origin, within = typing.get_origin(hint), typing.get_args(hint)
    if hint in _KINDS:
        return _KINDS[hint]
    if origin in (typing.Union, types.UnionType):
        return " or ".join(dict.fromkeys(map(_words, within)))
    if origin is typing.Literal:
        return "one of " + ", ".join(map(str, within))
    if origin is np.ndarray:
        return "an array of numbers"
    if origin in _SEVERAL:
        return "a sequence"
    kind = origin or hint
    return f"a {getattr(kind, '__name__', 'value')}"


def _shown(value: Any) -> str:
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


def _require_finite(made: Any, infinite: Sequence[str]) -> None:
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
