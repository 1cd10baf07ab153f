"""What solvers have in common: the programme at hand, and modes that exist."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TypeVar

from rrnn_opt.errors import ArgumentError, RrnnError
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


def require_mode(given: str, *known: str) -> None:
    """Refuse a mode that a solver does not have.

    Args:
        given: what was asked for.
        known: the solver's modes.

    Raises:
        ArgumentError: it is none of them.
    """
    if given not in known:
        raise ArgumentError("mode", f"'{given}' is none of {', '.join(known)}")


@dataclass
class DenseSession:
    """A session over dense programmes of one shape."""

    _problem: Dense | None = field(default=None, init=False, repr=False)

    def update(self, instance: Instance) -> None:
        """Take the next numbers; they are handed over in ``solve``."""
        self._problem = Dense.of(instance.problem)
