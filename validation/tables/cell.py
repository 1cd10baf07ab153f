"""A number of the paper beside ours."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Literal

from rrnn_opt.report.markdown import markdown_table as markdown

__all__ = ["Cell", "Verdict", "judged", "markdown"]

Verdict = Literal[
    "reproduced", "better", "not reproduced", "cannot be reproduced as printed"
]


@dataclass(frozen=True)
class Cell:
    """One cell of a table.

    Attributes:
        table: e.g. "III".
        row: as the paper names it.
        column: as the paper names it.
        paper: its number.
        ours: ours.
        interval: 95 % confidence interval of ours.
        n: trials behind ours.
        verdict: on the paper's number.
        reason: one sentence.
        command: that makes the number.
    """

    table: str
    row: str
    column: str
    paper: float
    ours: float
    interval: tuple[float, float]
    n: int
    verdict: Verdict
    reason: str
    command: str

    def to_dict(self) -> dict[str, Any]:
        """The cell as ``rrnn reproduce --json`` prints it."""
        return {**asdict(self), "interval": list(self.interval)}


def judged(
    paper: float,
    ours: float,
    interval: tuple[float, float],
    *,
    larger_is_better: bool,
) -> Verdict:
    """Reproduced when the interval holds the paper's number, else better or not.

    Args:
        paper: the paper's number.
        ours: ours.
        interval: of ours.
        larger_is_better: direction of "better".
    """
    if interval[0] <= paper <= interval[1]:
        return "reproduced"
    return "better" if (ours > paper) == larger_is_better else "not reproduced"
