"""The verdicts that are expected, read when all others are known."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

TABLE = Path(__file__).with_name("expected.toml")


def surprises(rows: Sequence[Mapping[str, Any]]) -> dict[str, str]:
    """Rows that did not come out as expected.

    Args:
        rows: of ``rrnn verify --json``, all settled.

    Returns:
        What was expected, by the row's id; a row that the table lacks is
        expected to be missing from the run.
    """
    table = tomllib.loads(TABLE.read_text(encoding="utf-8"))
    expected = {name: word for word, names in table.items() for name in names}
    found = {row["id"]: _word(row) for row in rows}
    return {
        name: expected.get(name, "no such row")
        for name, word in found.items()
        if expected.get(name) != word
    }


def _word(row: Mapping[str, Any]) -> str:
    """The verdict; for an entry without a proposition, its kind."""
    return str(row["verdict"] if row["kind"] == "PROPOSITION" else row["kind"])
