"""What all solvers of dense programmes have in common: the programme at hand."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TypeVar

from rrnn_opt.errors import RrnnError
from rrnn_opt.solving.parts import Dense
from rrnn_opt.solving.protocol import Instance

T = TypeVar("T")


def require_setup(given: T | None) -> T:
    """What ``setup`` was given.

    Raises:
        RrnnError: ``setup`` was not called.
    """
    if given is None:
        raise RrnnError("call setup(instance) before solve()")
    return given


@dataclass
class DenseSession:
    """A session over dense programmes of one shape."""

    _problem: Dense | None = field(default=None, init=False, repr=False)

    def update(self, instance: Instance) -> None:
        """Take the next numbers; they are handed over in ``solve``."""
        self._problem = Dense.of(instance.problem)
