"""Run the parts of the paper, keep their rows, and write the report.

Each part has a study; the rows of the studies are all that the report knows.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

from rrnn_opt.report import write_bytes, write_text
from rrnn_opt.study import Results, Row, Study, Workers, rows_digest, table
from rrnn_opt.validation.figures import figure_3, figure_4, figure_5
from rrnn_opt.validation.figures import raven as raven_figure
from rrnn_opt.validation.reproduce.cells import MAKERS
from rrnn_opt.validation.reproduce.studies import (
    Activities,
    Curves,
    Errors,
    Marks,
    Ways,
)
from rrnn_opt.validation.studies.raven import RavenTrials
from rrnn_opt.validation.tables.trials import PlanningTrials

Watch = Callable[[int, int], None]
PARTS = tuple(MAKERS)
PRINTED_MOST = 200
"""Trials of Algorithm 1 as printed, at most: most of its runs spend the budget."""


@dataclass(frozen=True)
class Part:
    """A table or figure that was run.

    Attributes:
        name: of ``PARTS``.
        rows: of its study.
        cells: what the report says, each with its command and its rows' digest.
        digest: of the rows.
    """

    name: str
    rows: tuple[Row, ...]
    cells: tuple[Mapping[str, Any], ...]
    digest: str


def studies(trials: int) -> dict[str, Study]:
    """The study behind each part; Tables III and IV share one.

    Args:
        trials: of each planner and scheme, as in the paper's 50 experiments.
    """
    planning = PlanningTrials(trials=trials, printed=min(trials, PRINTED_MOST))
    return {
        "table1": Marks(max(4, min(20, 2 * trials // 5))),
        "table2": Errors(trials, 12 if trials < 50 else 40),
        "table3": planning,
        "table4": planning,
        "fig3": Curves(max(2, min(20, trials // 2))),
        "fig4": Ways(),
        "fig5": Activities(max(1, min(20, trials // 5))),
        "raven": RavenTrials(trials),
    }


def run_part(
    name: str,
    results: Results,
    *,
    trials: int,
    workers: Workers | None = None,
    progress: Watch | None = None,
) -> Part:
    """Run what is left of a part and make its cells.

    Args:
        name: of ``PARTS``.
        results: where rows are kept.
        trials: see ``studies``.
        workers: where it runs; here by default.
        progress: told (finished, all).
    """
    study = studies(trials)[name]
    found = results.run(study, workers=workers, progress=progress)
    lost = [row for row in found if row.lost]
    return part_of(name, [*results.rows(study), *lost], trials=trials)


def part_of(name: str, rows: Iterable[Row], *, trials: int) -> Part:
    """The cells of a part from rows, whatever rows there are.

    Args:
        name: of ``PARTS``.
        rows: of its study.
        trials: for the command.
    """
    kept = tuple(rows)
    digest = rows_digest(kept)
    command = f"rrnn reproduce {name} --trials {trials}"
    good = [row.metrics for row in kept if not row.error]
    made = MAKERS[name](good)
    cells = tuple({**cell, "command": command, "rows": digest} for cell in made)
    return Part(name, kept, cells, digest)


def pictures(names: Sequence[str], out: Path, *, trials: int) -> dict[str, Path]:
    """Draw the figures among the parts; the paper's task from our runs.

    Args:
        names: of parts.
        out: folder.
        trials: see ``studies``.
    """
    starts = max(1, min(50, trials))
    draws: dict[str, Callable[[], bytes]] = {
        "fig3": lambda: figure_3.draw(figure_3.runs()),
        "fig4": figure_4.picture,
        "fig5": partial(figure_5.picture, starts),
    }
    drawn = {
        name: write_bytes(out / f"{name}.png", draw())
        for name, draw in draws.items()
        if name in names
    }
    if "raven" in names:
        raven_figure.draw(out / "raven.png")
        drawn["raven"] = out / "raven.png"
    return drawn


def write_rows(parts: Sequence[Part], out: Path) -> dict[str, Path]:
    """The rows of each part as JSON lines, sorted by key, times left out.

    Args:
        parts: of the report.
        out: folder.
    """
    return {
        part.name: write_bytes(out / f"{part.name}.jsonl", table(part.rows))
        for part in parts
    }


def write_cells(parts: Sequence[Part], out: Path) -> tuple[Path, ...]:
    """All cells as JSON, and as Parquet where pyarrow is there.

    Args:
        parts: of the report.
        out: folder.
    """
    cells = [dict(cell) for part in parts for cell in part.cells]
    paths = [
        write_text(out / "cells.json", json.dumps({"cells": cells}, indent=1) + "\n")
    ]
    try:
        import pyarrow as pa
        import pyarrow.parquet as pq
    except ImportError:
        return tuple(paths)
    plain = [{**c, "paper": _text(c["paper"]), "ours": _text(c["ours"])} for c in cells]
    pq.write_table(pa.Table.from_pylist(plain), out / "cells.parquet")
    return (*paths, out / "cells.parquet")


def _text(value: Any) -> str | None:
    return None if value is None else str(value)
