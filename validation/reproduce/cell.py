"""One cell of the report: the paper's value, ours, and a verdict."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

Rows = Sequence[Mapping[str, Any]]

Cells = list[dict[str, Any]]

NOT, IMPOSSIBLE = "not reproduced", "cannot be reproduced as printed"

NO_ROWS = "no row of the study is there"


def cell(
    table: str,
    row: str,
    column: str,
    paper: Any,
    ours: Any,
    verdict: str,
    reason: str,
    *,
    bounds: Sequence[float] = (),
    n: int = 1,
) -> dict[str, Any]:
    """One cell in the form of ``rrnn reproduce --json``."""
    numbers = isinstance(paper, int | float) and isinstance(ours, int | float)
    return {
        "table": table,
        "row": row,
        "column": column,
        "paper": paper,
        "ours": ours,
        "interval": [float(b) for b in bounds],
        "difference": ours - paper if numbers else None,
        "n": n,
        "verdict": verdict,
        "reason": reason,
    }
