"""Rows of a study, kept in a folder so that a run can go on where it stopped."""

from __future__ import annotations

import os
import platform
from datetime import UTC, datetime
from importlib import metadata
from pathlib import Path
from typing import Any

from rrnn_opt.study import Results, Row, Study, processor


def collect(study: Study, folder: Path, *, jobs: int = 1) -> list[dict[str, Any]]:
    """Metrics of every case, in the study's order.

    Args:
        study: what to run.
        folder: of its finished rows; what is there is not run again.
        jobs: worker processes.

    Returns:
        Metrics of each case; {"error": ...} where it failed.
    """
    with Results(folder) as results:
        return [measured(row) for row in results.finish(study, jobs=jobs)]


def measured(row: Row) -> dict[str, Any]:
    """Metrics of a row; {"error": ...} where the case failed."""
    return dict(row.metrics) or {"error": row.error}


def surroundings(command: str) -> str:
    """Command, machine and date as lines of Markdown."""
    import rrnn_opt

    version = metadata.version(rrnn_opt.__name__)
    cores = f"{os.cpu_count()} cores, {platform.machine()}, {processor()}"
    date = datetime.now(UTC).strftime("%Y-%m-%d")
    return (
        f"Made by `{command}`  \n"
        f"on {cores}, {platform.system()}, Python {platform.python_version()},"
        f" rrnn_opt {version}, {date}."
    )
