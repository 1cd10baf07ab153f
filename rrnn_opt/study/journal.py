"""Finished rows as lines of text, each with a digest of what it says."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from typing import Any

from rrnn_opt.study.lines import Lines

FIELDS = ("identity", "study", "key", "seed", "error", "time_s", "metrics")
"""What a kept row holds; ``check`` is a digest of all of them."""

Entry = Mapping[str, Any]


def sealed(entry: Mapping[str, Any]) -> dict[str, Any]:
    """The entry with its digest."""
    return {**entry, "check": _digest(entry)}


def intact(entry: Any) -> bool:
    """Whether an entry has its fields, no others, and they give its digest."""
    if not isinstance(entry, dict) or set(entry) != {*FIELDS, "check"}:
        return False
    try:
        same = bool(entry["check"] == _digest(entry))
        return same and len(bytes.fromhex(entry["identity"])) > 0
    except (TypeError, ValueError, RecursionError):
        return False


def _digest(entry: Mapping[str, Any]) -> str:
    parts = [entry[name] for name in FIELDS]
    return hashlib.sha256(json.dumps(parts).encode()).hexdigest()[:16]


class Journal(Lines):
    """Lines of kept rows; one whose digest is wrong does not count."""

    def accepts(self, entry: Mapping[str, Any]) -> bool:
        """Whether the digest fits."""
        return intact(entry)
