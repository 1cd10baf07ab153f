"""What the demo reports: checks with a number and a tolerance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Check:
    """One question that a stage answers.

    Attributes:
        name: what was checked.
        passed: the answer.
        value: the number or verdict found.
        wanted: tolerance or verdict that it was held against.
    """

    name: str
    passed: bool
    value: str
    wanted: str

    def to_dict(self) -> dict[str, Any]:
        """The check, ready for JSON."""
        return {
            "name": self.name,
            "passed": self.passed,
            "value": self.value,
            "wanted": self.wanted,
        }


def at_most(name: str, value: float, tolerance: float, unit: str = "") -> Check:
    """``value <= tolerance``; a value that is no number does not pass."""
    tail = f" {unit}" if unit else ""
    return Check(
        name, value <= tolerance, f"{value:.3g}{tail}", f"<= {tolerance:g}{tail}"
    )


def verdict(name: str, found: str, wanted: str, note: str = "") -> Check:
    """A verdict that must be the wanted one."""
    value = f"{found} ({note})" if note else found
    return Check(name, found == wanted, value, wanted)
