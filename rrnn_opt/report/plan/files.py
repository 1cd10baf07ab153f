"""The files of a plan, as ``rrnn plan --out`` and the demo leave them."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from typing import Any

from rrnn_opt.report.files import write_bytes, write_text
from rrnn_opt.report.plan.drawing import drawing_of
from rrnn_opt.report.plan.page import page
from rrnn_opt.report.plan.picture import picture

DRAWN = ("trajectory.csv", "plan.png", "plan.html")
BLOCKS = ("q", "qd", "qdd")


def write_plan(document: dict[str, Any], folder: str | Path) -> tuple[Path, ...]:
    """Write plan.json, trajectory.csv, plan.png and plan.html, in this order.

    Args:
        document: plan result.
        folder: is made if it is missing.

    Returns:
        The files written; there is no CSV without a trajectory.

    Files of an earlier plan in that folder go first, so that no kill and no full
    disk leaves two plans mixed.

    Raises:
        DocumentError: the document is not a plan result.
        OSError: a file cannot be written; it is then not there at all.
    """
    target = Path(folder)
    target.mkdir(parents=True, exist_ok=True)
    text = json.dumps(document, indent=1, allow_nan=False) + "\n"
    for name in DRAWN:  # of an earlier plan: they must not stand beside this one
        (target / name).unlink(missing_ok=True)
    paths = [write_text(target / "plan.json", text)]
    if document.get("trajectory"):
        rows = csv_text(document["trajectory"])
        paths.append(write_text(target / "trajectory.csv", rows))
    drawing = drawing_of(document)
    paths.append(write_bytes(target / "plan.png", picture(document, drawing)))
    paths.append(write_text(target / "plan.html", page(document, drawing)))
    return tuple(paths)


def csv_text(trajectory: dict[str, Any]) -> str:
    """The trajectory's rows: t, then q, qd and qdd of every joint.

    Args:
        trajectory: ``trajectory`` block of a plan result.
    """
    nv = len(trajectory["q"][0])
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["t", *(f"{b}{k + 1}" for b in BLOCKS for k in range(nv))])
    columns = (trajectory["t"], *(trajectory[block] for block in BLOCKS))
    for t, *rows in zip(*columns, strict=True):
        writer.writerow([t, *(x for row in rows for x in row)])
    return text.getvalue()
