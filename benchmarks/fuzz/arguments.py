"""Python constructors and functions: one or two arguments are not as documented."""

from __future__ import annotations

import dataclasses
import functools
import math
import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.fuzz import mutation
from benchmarks.fuzz.judging import ACCEPTED, Entry, require
from benchmarks.fuzz.law_calls import other_calls, symbolic_calls
from benchmarks.fuzz.motion_calls import Call, motion_calls, robot_calls

MAY_BE_INFINITE = ("longest_step", "patience_s", "primal", "dual", "gap")
MAY_BE_INFINITE += ("complementarity",)
"""Residuals are infinite where the answer is no answer."""

GROUPS = {
    "robots and scenes in Python": (robot_calls, 5),
    "motion and planning in Python": (motion_calls, 4),
    "schemes, networks and solvers in Python": (symbolic_calls, 5),
    "studies, proofs and packages in Python": (other_calls, 2),
}


Maker = Callable[[random.Random], Any]


def attempt(
    calls: Callable[[], dict[str, Call]],
    rng: random.Random,
    _: Path,
    make: Maker = mutation.argument,
) -> str:
    """One call with one or two arguments replaced."""
    known = calls()
    name = rng.choice(sorted(known))
    function, given = known[name]
    changed = dict(given)
    for key in rng.sample(sorted(given), min(len(given), rng.choice((1, 1, 1, 2)))):
        changed[key] = make(rng)
    if rng.random() < 0.05:
        changed.pop(rng.choice(sorted(changed)))
    try:
        made = function(**changed)
    except TypeError as error:
        if "argument" in str(error) and str(error).split("(")[0] in _own_names(
            function
        ):
            return "refused"  # Python's own word on a missing argument
        raise
    _true(name, made)
    return ACCEPTED


def _own_names(function: Any) -> tuple[str, ...]:
    name = getattr(function, "__qualname__", "")
    return (name, f"{name}.__init__", name.split(".")[-1])


def _true(name: str, made: Any) -> None:
    """What was made must hold finite numbers where it holds numbers."""
    if not dataclasses.is_dataclass(made) or isinstance(made, type):
        return
    for field in dataclasses.fields(made):
        value = getattr(made, field.name)
        number = isinstance(value, float) and not isinstance(value, bool)
        where = f"{name}.{field.name}"
        if number and field.name not in MAY_BE_INFINITE:
            require(math.isfinite(value), f"{where} is {value}")
        if isinstance(value, np.ndarray) and field.name not in ("lower", "upper"):
            require(value.dtype != object, f"{where} holds objects")
            if value.dtype.kind == "f":
                require(np.all(np.isfinite(value)), f"{where} is not finite")


ENTRIES = tuple(
    Entry(name, functools.partial(attempt, calls), share)
    for name, (calls, share) in GROUPS.items()
)
