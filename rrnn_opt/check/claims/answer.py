"""What one method of checking answers; nothing is sealed here.

A method reads a claim and a payload and returns an :class:`Answer`, or raises
:class:`~rrnn_opt.errors.UndecidedError` with the reason.  Only
:mod:`rrnn_opt.check.claims.certificate` turns an answer into a verdict.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

PROVED, REFUTED = "PROVED", "REFUTED"
HOLDS_UNDER, UNKNOWN = "HOLDS_UNDER", "UNKNOWN"

TRUSTS = ("exact", "arb", "interval", "smt", "pen")
"""What a verdict can rest on, strongest first.

exact: rational arithmetic.  arb: balls of python-flint.  interval: doubles
rounded outwards.  smt: the word of an SMT solver.  pen: a proof on paper.
"""


@dataclass(frozen=True)
class Answer:
    """What a method found.

    Attributes:
        status: PROVED or REFUTED; that a proof assumes something is added by
            the caller.
        reason: half a sentence.
        trust: one of :data:`TRUSTS`.
        assumptions: what the proof needs beyond the claim, "D1: ..".

    Raises:
        ValueError: there is no such status or trust.
    """

    status: Literal["PROVED", "REFUTED"]
    reason: str
    trust: str
    assumptions: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if self.trust not in TRUSTS or self.status not in (PROVED, REFUTED):
            raise ValueError(f"no such answer: {self.status}, {self.trust}")


def weakest(*trusts: str) -> str:
    """The weakest of some trust words: a chain is as strong as that."""
    return max(trusts, key=TRUSTS.index)


def undefined(partial: tuple[str, ...]) -> tuple[str, ...]:
    """The assumption that operations which may be undefined are defined."""
    if not partial:
        return ()
    return (f"D1: every operation of the graph is defined ({', '.join(partial)})",)
