"""``rrnn reproduce``: the paper's tables and figures beside ours."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from typing import Any

from rrnn_opt.cli.arguments import count
from rrnn_opt.cli.compare import add_study_arguments
from rrnn_opt.cli.folders import folder
from rrnn_opt.cli.named import unknown
from rrnn_opt.cli.output import Output, UsageError

HELP = "run the paper's tables, figures and the Raven II experiment again"
PATIENCE_S = 1800.0
"""Wall time that one case may take, s."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's arguments."""
    parser.add_argument(
        "part",
        nargs="*",
        default=["all"],
        help="table1 .. table4, fig3 .. fig5, raven, or all (the default)",
    )
    parser.add_argument("--trials", type=count, default=50, help="default 50")
    add_study_arguments(parser)
    parser.set_defaults(jobs=min(2, os.cpu_count() or 1))


def run(args: argparse.Namespace, out: Output) -> int:
    """0 when every part was run; 1 when a case failed.

    Raises:
        UsageError: a part is unknown.
    """
    from rrnn_opt.study import pin_threads

    pin_threads()
    names = _names(args.part)
    target = folder(args.out.replace("{}", "reproduce"))
    parts, damaged = _run(args, names, target, out)
    files = _written(args, parts, damaged, target)
    cells = [dict(cell) for part in parts for cell in part.cells]
    out.document(
        {"cells": cells, "damaged": damaged, "files": [str(path) for path in files]}
    )
    _say(out, cells, files)
    return 1 if any(row.error for part in parts for row in part.rows) else 0


def _names(words: list[str]) -> list[str]:
    from rrnn_opt.validation.reproduce.run import PARTS

    for word in words:
        if word not in (*PARTS, "all"):
            raise UsageError(unknown("part", word, (*PARTS, "all")))
    return [name for name in PARTS if name in words or "all" in words]


def _run(
    args: argparse.Namespace, names: list[str], target: Path, out: Output
) -> tuple[list[Any], int]:
    from rrnn_opt.study import Cluster, Processes, Progress, Results
    from rrnn_opt.validation.reproduce.run import run_part

    workers: Any = Processes(args.jobs, patience_s=PATIENCE_S)
    if args.dask is not None:
        workers = Cluster(args.dask)
    parts = []
    with Results(target / "rows", seed=args.seed, resume=args.resume) as results:
        if results.damaged:
            out.note(f"rrnn: {results.damaged} damaged rows are measured again")
        for name in names:
            progress = Progress(sys.stderr, label=f"{name} ")
            try:
                part = run_part(
                    name,
                    results,
                    trials=args.trials,
                    workers=workers,
                    progress=progress,
                )
            finally:
                progress.close()
            parts.append(part)
        return parts, results.damaged


def _written(
    args: argparse.Namespace, parts: list[Any], damaged: int, target: Path
) -> tuple[Path, ...]:
    from rrnn_opt.study import environment
    from rrnn_opt.validation.reproduce import report
    from rrnn_opt.validation.reproduce.run import pictures, write_cells, write_rows

    drawn = pictures([part.name for part in parts], target, trials=args.trials)
    rows = write_rows(parts, target)
    settings = {"trials": args.trials, "jobs": args.jobs, "dask": args.dask}
    pages = report.write_report(
        target,
        parts,
        drawn=drawn,
        environment=environment(settings),
        damaged=damaged,
    )
    return (*pages, *write_cells(parts, target), *drawn.values(), *rows.values())


def _say(out: Output, cells: list[dict[str, Any]], files: tuple[Path, ...]) -> None:
    from rrnn_opt.report import table

    head = ("table", "row", "column", "paper", "ours", "n", "verdict")
    out.say(table(head, [[cell[key] for key in head] for cell in cells]))
    for path in files:
        out.say(f"  {path}")
