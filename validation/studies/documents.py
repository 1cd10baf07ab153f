"""Tables of the ground truth: JSON and CSV with every pair, Markdown to read."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from rrnn_opt.report import write_text
from rrnn_opt.validation.studies.page import markdown
from rrnn_opt.validation.studies.tally import AnswerTally, PointTally, add, plain

Rows = Sequence[Mapping[str, Any]]

_PAIR = ("robot", "scheme", "who", "kind")
_POINTS = ("n", "bound", "contact", "well", "well_dual", "proved")
_ANSWER = (
    "answered",
    "right",
    "wrong",
    "missed",
    "newton",
    "residual",
    "primal",
    "dual",
    "truth_primal",
    "truth_dual",
    "statuses",
    "apart",
    "examples",
)


def write(out: Path, results: Rows, *, title: Sequence[str]) -> Path:
    """Write ``ground_truth.json``, ``.csv`` and ``.md`` into a folder.

    Args:
        out: the folder; made where it is missing.
        results: metrics of the studies' rows.
        title: lines at the top of the Markdown page: command, machine, date.

    Returns:
        The Markdown page.
    """
    out.mkdir(parents=True, exist_ok=True)
    table = pairs(results)
    words = [row for row in results if "infeasible" in row]
    data = {"title": list(title), "pairs": table, "infeasible": words}
    write_text(out / "ground_truth.json", json.dumps(data, indent=1))
    rows = io.StringIO(newline="")
    writer = csv.DictWriter(rows, [*_PAIR, *_POINTS, *_ANSWER])
    writer.writeheader()
    writer.writerows(table)
    write_text(out / "ground_truth.csv", rows.getvalue())
    text = markdown(results, table, title=title)
    return write_text(out / "ground_truth.md", text)


def pairs(results: Rows) -> list[dict[str, Any]]:
    """One row a scheme, robot and network or solver.

    Args:
        results: metrics of the studies' rows.
    """
    points: dict[tuple[str, str], PointTally] = {}
    answers: dict[tuple[str, str, str, str], AnswerTally] = {}
    for row in results:
        if "points" not in row:
            continue
        place = (row["robot"], row["scheme"])
        add(points.setdefault(place, PointTally()), row["points"])
        for kind in ("solvers", "networks"):
            for name, tally in row[kind].items():
                key = (*place, name, kind[:-1])
                add(answers.setdefault(key, AnswerTally()), tally)
    return [
        dict(zip(_PAIR, key, strict=True))
        | {k: plain(points[key[:2]])[k] for k in _POINTS}
        | {k: plain(tally)[k] for k in _ANSWER}
        for key, tally in answers.items()
    ]
