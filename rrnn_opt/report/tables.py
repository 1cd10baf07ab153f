"""Plain-text tables and check lines for the terminal."""

from __future__ import annotations

from collections.abc import Sequence

from rrnn_opt.errors import RrnnError

PASS, FAIL = "PASS", "FAIL"


def table(
    header: Sequence[str], rows: Sequence[Sequence[object]], *, indent: int = 0
) -> str:
    """A table with a rule under its header; numbers stand on the right.

    Args:
        header: titles of the columns.
        rows: cells; floats are written with four significant digits, None as
            a dash.
        indent: spaces before each line.

    Returns:
        Lines joined by newlines, without a last newline.

    Raises:
        RrnnError: a row has not as many cells as the header.
    """
    cells = [[cell_text(c) for c in row] for row in rows]
    if any(len(row) != len(header) for row in cells):
        raise RrnnError(f"every row needs {len(header)} cells")
    columns = list(zip(header, *cells, strict=True))
    widths = [max(len(cell) for cell in column) for column in columns]
    right = [
        bool(rows) and all(isinstance(row[k], int | float | None) for row in rows)
        for k in range(len(header))
    ]
    lines = [list(header), ["\N{BOX DRAWINGS LIGHT HORIZONTAL}" * w for w in widths]]
    return "\n".join(
        (" " * indent + "  ".join(map(_padded, line, widths, right))).rstrip()
        for line in [*lines, *cells]
    )


def cell_text(value: object) -> str:
    """One cell as text on one line."""
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.4g}"
    return " ".join(str(value).split())


def check_line(
    name: str, holds: bool, number: float | None = None, limit: float | None = None
) -> str:
    """``PASS name  number <= limit``: one line of a list of checks.

    Args:
        name: what was checked.
        holds: whether it holds.
        number: what was measured, in the unit that the name says.
        limit: its largest allowed value, likewise.
    """
    text = f"{PASS if holds else FAIL}  {name}"
    if number is not None:
        text += f"  {number:.3g}"
    if limit is not None:
        text += f" {'<=' if holds else '>'} {limit:.3g}"
    return text


def _padded(text: str, width: int, right: bool) -> str:
    return text.rjust(width) if right else text.ljust(width)
