"""``rrnn view``: the offline page of a plan, of claims, or of a study."""

from __future__ import annotations

import argparse
from pathlib import Path

from rrnn_opt.cli.check import read
from rrnn_opt.cli.output import Output
from rrnn_opt.errors import DocumentError
from rrnn_opt.files import shown_path

HELP = "name the offline HTML page of a plan, of claims or of a study"
REPORTS = ("claims.html", "compare.html", "reproduce.html")
"""Pages that commands leave in their folders."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.add_argument(
        "result", metavar="RESULT", help="plan.json, or the folder of a plan or report"
    )
    parser.add_argument(
        "--out", metavar="FILE", help="a plan's page (default: beside the result)"
    )


def run(args: argparse.Namespace, out: Output) -> int:
    """Write the page of a plan, or find that of a report, and print its path.

    Raises:
        DocumentError: the folder holds neither a plan nor a page.
    """
    source = Path(args.result)
    page = _report(source)
    if page is None:
        page = _plan(source / "plan.json" if source.is_dir() else source, args.out)
    out.document({"page": str(page)})
    out.say(str(page))
    return 0


def _plan(source: Path, wanted: str | None) -> Path:
    """The page of a plan result, written now."""
    document = read(str(source))
    from rrnn_opt.report import write_page

    target = Path(wanted) if wanted else source.with_suffix(".html")
    write_page(document, target)
    return target


def _report(source: Path) -> Path | None:
    """The page that a command wrote beside its rows; None for a plan.

    Raises:
        DocumentError: the folder holds neither a plan nor a page.
    """
    if source.is_file():
        page = source.with_suffix(".html")
        return page if page.name in REPORTS and page.is_file() else None
    if not source.is_dir() or (source / "plan.json").exists():
        return None
    for name in REPORTS:
        if (source / name).is_file():
            return source / name
    where = shown_path(source)
    raise DocumentError(where, "holds neither plan.json nor a report's page")
