"""toppra, loaded without the plotting library that only its pictures need."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import ModuleType
from typing import Any


class Later(ModuleType):
    """Stands for a module, which is loaded when something of it is asked for."""

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        if sys.modules.get(self.__name__) is self:
            del sys.modules[self.__name__]
        return getattr(importlib.import_module(self.__name__), name)


@contextmanager
def without_pictures() -> Iterator[None]:
    """Inside, an import of matplotlib.pyplot loads nothing yet; outside, all is usual.

    Who imported it inside keeps a stand-in that loads the true module at its
    first use, so that nothing is missing afterwards.  Where matplotlib is loaded
    already, nothing is done.
    """
    if "matplotlib" in sys.modules:
        yield
        return
    package, plots = Later("matplotlib"), Later("matplotlib.pyplot")
    package.__dict__["pyplot"] = plots
    stands = {module.__name__: module for module in (package, plots)}
    sys.modules.update(stands)
    try:
        yield
    finally:
        for name, module in stands.items():
            if sys.modules.get(name) is module:
                del sys.modules[name]


def load() -> tuple[ModuleType, ModuleType]:
    """``toppra.algorithm`` and ``toppra.constraint``."""
    with without_pictures():
        algorithm = importlib.import_module("toppra.algorithm")
        constraint = importlib.import_module("toppra.constraint")
    return algorithm, constraint
