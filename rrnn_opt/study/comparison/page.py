"""The report of a comparison: Markdown, HTML, a picture, and the summaries as JSON."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.report import write_bytes, write_text
from rrnn_opt.report.profiles import draw_profiles
from rrnn_opt.report.simple_page import html_page
from rrnn_opt.study.cases import Row
from rrnn_opt.study.comparison.advice import advice
from rrnn_opt.study.comparison.measure import Comparison
from rrnn_opt.study.comparison.page_tables import (
    answers_table,
    gains_table,
    infeasible_table,
    solvers_table,
    unfinished,
)
from rrnn_opt.study.comparison.profiles import TimeTable, time_table
from rrnn_opt.study.comparison.statistics import SHIFT_US
from rrnn_opt.study.comparison.summary import TOLERANCE, summaries

_ABOUT = f"""\
Every answer is judged here, by its absolute KKT residuals (primal, dual, gap,
complementarity): *solved* means all within {TOLERANCE:g}, whatever the solver says of
itself; *relative* counts those whose residuals are within {TOLERANCE:g} of the sizes
of their terms. *cold*: set up anew for each problem; *warm*: set up anew and told the
last answer; *stream*: set up once, then only the numbers change. Times are wall times
of one call from Python, in microseconds, over all passes; *inner* is what the solver
counts for itself (medians); the rest is the price of the call from Python. *mean* is
the geometric mean of the median times, shifted by {SHIFT_US:g} us. *spread* is the
interquartile range over the passes relative to the median. The first call stands
apart. Garbage collection is off between calls; every process has one thread. Profiles
and ranks hold under these tolerances and on this machine only."""


def write_report(
    out: Path,
    study: Comparison,
    rows: Sequence[Row],
    *,
    environment: Mapping[str, Any],
    command: str,
    digest: str,
    notes: Sequence[str] = (),
) -> tuple[Path, ...]:
    """Write ``compare.md``, ``.html``, ``.png`` and ``.json`` into a folder.

    Args:
        out: the folder; it exists.
        study: what was run.
        rows: of the study.
        environment: of the run.
        command: that makes it.
        digest: of the rows.
        notes: sets that could not be made here, and the like.
    """
    found, table = summaries(rows), time_table(rows, study.sets)
    title = ", ".join(study.sets[:6]) + (", ..." if len(study.sets) > 6 else "")
    picture = draw_profiles(_plain(table), _pooled(rows), title=title)
    data = {"command": command, "environment": environment, "rows": found}
    text = page(study, rows, environment=environment, command=command, digest=digest)
    if notes:
        text += "\n## Left out\n\n" + "\n".join(f"- {note}" for note in notes) + "\n"
    paths = [
        write_bytes(out / "compare.png", picture),
        write_text(out / "compare.md", text),
        write_text(out / "compare.json", json.dumps(data, indent=1) + "\n"),
    ]
    whole = html_page(text, title="Solver comparison", folder=out)
    return (*paths, write_text(out / "compare.html", whole))


def page(
    study: Comparison,
    rows: Sequence[Row],
    *,
    environment: Mapping[str, Any],
    command: str,
    digest: str,
) -> str:
    """The report in Markdown."""
    found = summaries(rows)
    parts = [
        "# Solver comparison",
        _made(environment, command, digest),
        "![profiles](compare.png)",
        "## Which solver when",
        "\n".join(f"- {line}" for line in advice(rows, study.sets)),
        "## How to read it",
        _ABOUT,
    ]
    for name in study.sets:
        mine = [row for row in found if row["stream"] == name]
        problems = study.problems(name)
        parts += [f"## {name}", f"{problems.about}.", answers_table(mine)]
        parts += unfinished(mine)
    parts += ["## Gain of a warm start", gains_table(found)]
    if any(row.get("infeasible") for row in found):
        parts += ["## Problems without a solution", infeasible_table(found)]
    parts += ["## Who was asked", solvers_table(study)]
    return "\n\n".join(parts) + "\n"


def _made(environment: Mapping[str, Any], command: str, digest: str) -> str:
    versions = ", ".join(f"{k} {v}" for k, v in environment["versions"].items())
    return "  \n".join(
        [
            f"Command: `{command}`",
            f"Machine: {environment['processor']}, {environment['cores']} cores, "
            f"load {environment['load'][0]:g}, Python {environment['python']}",
            f"Versions: {versions}",
            f"Date: {environment['date']}, commit {environment['commit']}, "
            f"rows {digest}",
        ]
    )


def _plain(table: TimeTable) -> dict[str, Any]:
    times = [[t if math.isfinite(t) else None for t in line] for line in table.times]
    worst = [None if math.isnan(w) else float(w) for w in table.worst]
    return {**table.profiles(), "times": times, "worst": worst}


def _pooled(rows: Sequence[Row]) -> list[dict[str, Any]]:
    """Percentiles over all sets of a line, for the picture."""
    from rrnn_opt.study.comparison.statistics import percentiles

    pooled: dict[str, list[float]] = {}
    for row in rows:
        if row.error:
            continue
        label = "{solver}, {mode}".format(**row.metrics)
        there = [t != "infeasible" for t in row.metrics["truth"]]
        times = np.array(row.metrics["times_us"])[:, there]
        pooled.setdefault(label, []).extend(times.ravel().tolist())
    return [
        {"label": label, "time_us": percentiles(times)}
        for label, times in pooled.items()
        if times
    ]
