"""``rrnn view``: an offline page of a plan result."""

from __future__ import annotations

import argparse
from pathlib import Path

from rrnn_opt.cli.check import read
from rrnn_opt.cli.output import Output

HELP = "write an offline HTML page of a plan result and name it"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.add_argument("result", metavar="RESULT", help="plan.json, or its folder")
    parser.add_argument(
        "--out", metavar="FILE", help="the page (default: beside the result)"
    )


def run(args: argparse.Namespace, out: Output) -> int:
    """Write the page and print its path."""
    source = Path(args.result)
    source = source / "plan.json" if source.is_dir() else source
    document = read(str(source))
    from rrnn_opt.report import write_page

    target = Path(args.out) if args.out else source.with_suffix(".html")
    write_page(document, target)
    out.document({"page": str(target)})
    out.say(str(target))
    return 0
