"""Sections of ``docs/results/fuzz.md``, each put there by the command that made it."""

from __future__ import annotations

from pathlib import Path

from rrnn_opt.report import write_text

PAGE = Path(__file__).parents[2] / "docs" / "results" / "fuzz.md"
ENDINGS, BRANCHES = "Endings", "Branches of the readers"


def put(section: str, text: str, page: Path = PAGE) -> None:
    """Replace the text of a section, or add it at the end.

    Args:
        section: its heading.
        text: what stands below the heading.
        page: the page; made when there is none.
    """
    old = page.read_text("utf-8") if page.exists() else "# Bad input\n"
    first, *rest = old.split("\n## ")
    parts = {part.split("\n", 1)[0]: part for part in rest}
    parts[section] = f"{section}\n\n{text.strip()}\n"
    write_text(page, "\n## ".join([first.rstrip("\n") + "\n", *parts.values()]))
