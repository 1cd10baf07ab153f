"""``@checked``: a call's arguments are of the kinds that the signature says."""

from __future__ import annotations

import functools
import inspect
import typing
from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import numpy as np

from rrnn_opt.arguments.annotations import accepts_numbers, hint_of
from rrnn_opt.arguments.kinds import Test, accepts
from rrnn_opt.arguments.require import require_finite
from rrnn_opt.arguments.words import part_of, refusal, words_of
from rrnn_opt.errors import ArgumentError

Checked = TypeVar("Checked", bound=Callable[..., Any])
Arguments = tuple[tuple[Any, ...], dict[str, Any]]
_REST = (inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)


def checked(
    *, skip: Sequence[str] = (), infinite: Sequence[str] = ()
) -> Callable[[Checked], Checked]:
    """A decorator for a function or a dataclass that takes what users write.

    An array without axes stands for its number where a number is asked for.

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
            guard = _Guard(make, target, skip)

            @functools.wraps(make)
            def init(self: Any, *args: Any, **given: Any) -> None:
                args, given = guard(target.__name__, (self, *args), given)
                make(*args, **given)
                require_finite(self, infinite)

            target.__init__ = init  # type: ignore[misc]
            return target
        guard = _Guard(target, None, skip)
        where = _named(target)

        @functools.wraps(target)
        def call(*args: Any, **given: Any) -> Any:
            args, given = guard(where, args, given)
            return target(*args, **given)

        return typing.cast(Checked, call)

    return decorate


def _named(function: Callable[..., Any]) -> str:
    """What a message calls it: a method with its class, a constructor by that alone."""
    name = function.__qualname__.rpartition("<locals>.")[2]
    return name.removesuffix(".__init__").removesuffix(".__call__")


class _Guard:
    """What looks at the arguments of a call; it reads annotations when first used."""

    def __init__(
        self, function: Callable[..., Any], owner: type | None, skip: Sequence[str]
    ) -> None:
        self._function, self._owner, self._skip = function, owner, skip

    def __call__(
        self, where: str, args: tuple[Any, ...], given: dict[str, Any]
    ) -> Arguments:
        """The arguments, arrays without axes as numbers; refused if of another kind."""
        try:
            bound = self._signature.bind(*args, **given)
        except TypeError as error:
            raise ArgumentError(where, str(error)) from None
        numbers = {}
        for name, value in bound.arguments.items():
            test, words, part = self._tests.get(name, (None, "", None))
            if test is None or test(value):
                continue
            if not _is_number(value) or not test(value.item()):
                raise refusal(f"{where}: {name}", value, words, part)
            numbers[name] = value.item()
        bound.arguments.update(numbers)
        return (bound.args, bound.kwargs) if numbers else (args, given)

    @functools.cached_property
    def _signature(self) -> inspect.Signature:
        return inspect.signature(self._function)

    @functools.cached_property
    def _tests(self) -> dict[str, tuple[Test, str, Any]]:
        """By argument: its test, its kind in words, the type of its entries."""
        tests: dict[str, tuple[Test, str, Any]] = {}
        for name, parameter in self._signature.parameters.items():
            if name in self._skip or parameter.kind in _REST:
                continue
            numbers = accepts_numbers(parameter.annotation)
            hint = hint_of(name, parameter.annotation, self._function, self._owner)
            if numbers is not None:
                tests[name] = (numbers, "an array of numbers", None)
            elif hint is not None:
                tests[name] = (accepts(hint), words_of(hint), part_of(hint))
        return tests


def _is_number(value: Any) -> bool:
    """Whether a value is an array of no axes, and so one number."""
    return isinstance(value, np.ndarray) and value.ndim == 0
