"""Table II: circle tracking under white noise, with intervals.

    python -m rrnn_opt.validation.tables.table_2 --seeds 200 --points 40 --out DIR

What the paper leaves open is chosen and stated in ``tracking``; the gains of
every row are found by the one search of ``search``, on other noise.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.report import write_text
from rrnn_opt.validation.ending import ended
from rrnn_opt.validation.tables import tracking
from rrnn_opt.validation.tables.cell import Cell, Verdict, judged
from rrnn_opt.validation.tables.page import head, spelled
from rrnn_opt.validation.tables.search import search
from rrnn_opt.validation.tables.table_2_page import sections
from rrnn_opt.validation.tables.table_2_rows import Result
from rrnn_opt.validation.tables.tracking import (
    CIRCLES,
    ENTRIES,
    SIGMAS,
    Entry,
    Runner,
)

PRINTED = 0.0005
"""Half of the last digit that the paper prints, m: its 0.007 is 0.0065 to 0.0075."""

PROGRAM = "python -m rrnn_opt.validation.tables.table_2"


def measure(key: str, *, seeds: int, points: int) -> Result:
    """Search the gains of a row and run it.

    Args:
        key: of ``ENTRIES``.
        seeds: noise seeds 0, 1, ... of each circle and sigma.
        points: of the search.
    """
    entry = ENTRIES[key]
    trials = search(entry, points=points)
    runner = Runner(entry, trials[0].gains)
    errors = np.zeros((len(SIGMAS), len(CIRCLES), seeds))
    kept, unsettled = np.zeros(len(SIGMAS)), 0
    for i, sigma in enumerate(SIGMAS):
        for j, circle in enumerate(CIRCLES):
            for seed in range(seeds):
                run = runner.run(circle, sigma, seed)
                errors[i, j, seed] = run.rms_error_m
                kept[i] += run.limits_kept
                unsettled += run.record.unsettled
    runs = len(CIRCLES) * seeds
    periods = errors.size * len(run.t)
    share = tuple((kept / runs).tolist())
    return Result(key, trials, errors, share, unsettled / periods)


def results(*, seeds: int = 4, points: int = 6) -> Iterator[Result]:
    """All rows, as they are finished; see ``measure``."""
    for key in ENTRIES:
        yield measure(key, seeds=seeds, points=points)


def cells(
    found: Sequence[Result] | None = None, *, command: str = PROGRAM
) -> list[dict[str, Any]]:
    """The cells in the form of ``rrnn reproduce --json``.

    Args:
        found: rows; a small run by default.  Rows that the paper has not, have
            no cells.
        command: that made them.
    """
    rows = list(results()) if found is None else found
    return [
        _cell(row, i, command).to_dict()
        for row in rows
        for i in range(len(ENTRIES[row.key].paper))
    ]


def _cell(row: Result, sigma: int, command: str) -> Cell:
    entry = ENTRIES[row.key]
    paper = entry.paper[sigma]
    ours, bounds = float(row.means[sigma]), row.interval(sigma)
    return Cell(
        table="II",
        row=entry.label,
        column=f"sigma = {SIGMAS[sigma]}",
        paper=paper,
        ours=ours,
        interval=bounds,
        n=row.errors[sigma].size,
        verdict=verdict(entry, paper, ours, bounds),
        reason=entry.note,
        command=command,
    )


def verdict(
    entry: Entry, paper: float, ours: float, bounds: tuple[float, float]
) -> Verdict:
    """``judged`` in the digits printed; a rival that errs less is not the paper's.

    Args:
        entry: the row.
        paper: its number, m.
        ours: our mean, m.
        bounds: of ours.
    """
    wide = (bounds[0] - PRINTED, bounds[1] + PRINTED)
    found = judged(paper, ours, wide, larger_is_better=False)
    rival = entry.kind == "rival"
    return "not reproduced" if rival and found == "better" else found


def page(found: Sequence[Result], command: str) -> str:
    """The table in Markdown."""
    about = (tracking.__doc__ or "").split("\n", 2)[2].strip()
    text = about.replace("``CIRCLES``", "the table of circles")
    return "\n\n".join([head("Table II", command), text, *sections(found)]) + "\n"


def document(found: Sequence[Result], command: str) -> Mapping[str, Any]:
    """Cells and the search, JSON-ready."""
    return {
        "cells": cells(found, command=command),
        "search": {
            row.key: [
                {"gains": dict(t.gains), "score_m": t.score}
                for t in row.trials
                if np.isfinite(t.score)
            ]
            for row in found
        },
    }


def main(arguments: Sequence[str] | None = None) -> int:
    """Run, print the page and write it.

    Args:
        arguments: of the command line.
    """
    parser = argparse.ArgumentParser(prog=PROGRAM, description="Table II.")
    add = parser.add_argument
    add("--seeds", type=int, default=4, help="noise seeds of each circle and sigma")
    add("--points", type=int, default=6, help="of the search of each row's gains")
    add("--out", type=Path, help="folder of table_2.md and table_2.json")
    given = parser.parse_args(arguments)
    words = sys.argv[1:] if arguments is None else list(arguments)
    command, found = spelled(PROGRAM, words), []
    for row in results(seeds=given.seeds, points=given.points):
        found.append(row)
        print(f"{row.key}: {1e3 * row.means} mm", file=sys.stderr, flush=True)
    text = page(found, command)
    print(text)
    if given.out is not None:
        given.out.mkdir(parents=True, exist_ok=True)
        write_text(given.out / "table_2.md", text)
        data = json.dumps(document(found, command), indent=1) + "\n"
        write_text(given.out / "table_2.json", data)
    return 0


if __name__ == "__main__":
    sys.exit(ended(main))
