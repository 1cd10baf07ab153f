"""Rows of a study, kept in a folder so that a run can go on where it stopped."""

from __future__ import annotations

import os
import platform
from collections.abc import Sequence
from datetime import UTC, datetime
from importlib import metadata
from pathlib import Path
from typing import Any

from rrnn_opt.errors import RrnnError
from rrnn_opt.study import Results, Row, Study, processor


def collect(study: Study, folder: Path, *, jobs: int = 1) -> list[dict[str, Any]]:
    """Metrics of every case, in the study's order.

    Args:
        study: what to run.
        folder: of its finished rows; what is there is not run again.
        jobs: worker processes.

    Returns:
        Metrics of each case.

    Raises:
        RrnnError: cases failed; a table of the others would not be of the study.
    """
    with Results(folder) as results:
        return metrics_of(list(results.finish(study, jobs=jobs)))


def metrics_of(rows: Sequence[Row]) -> list[dict[str, Any]]:
    """Metrics of each row.

    Raises:
        RrnnError: cases failed; a table of the others would not be of the study.
    """
    failed = [row for row in rows if row.error]
    if failed:
        first = f"{failed[0].key}: {failed[0].error}"
        raise RrnnError(
            f"{len(failed)} of {len(rows)} cases failed; the first, {first}"
        )
    return [dict(row.metrics) for row in rows]


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
