"""The numbers that the paper prints, from the one file that holds them."""

from __future__ import annotations

import json
from functools import lru_cache
from importlib import resources
from typing import Any

Key = tuple[str, str, str]


@lru_cache(maxsize=1)
def printed_values() -> dict[Key, Any]:
    """Values by table, row and column, as the paper names them."""
    file = resources.files("rrnn_opt.validation") / "tables" / "printed.json"
    entries = json.loads(file.read_text("utf-8"))["values"]
    return {(e["table"], e["row"], e["column"]): e["value"] for e in entries}


def printed(table: str, row: str, column: str) -> Any:
    """One value: a word in Table I, else a number.

    Args:
        table: "I" to "IV".
        row: of the table.
        column: of the table.

    Raises:
        KeyError: the paper prints nothing there.
    """
    return printed_values()[table, row, column]


def printed_row(table: str, row: str) -> tuple[Any, ...]:
    """The values of one row, in the paper's order."""
    return tuple(
        value for (t, r, _), value in printed_values().items() if (t, r) == (table, row)
    )


def rows_of(table: str) -> tuple[str, ...]:
    """The rows of a table, in the paper's order."""
    return tuple(dict.fromkeys(row for t, row, _ in printed_values() if t == table))
