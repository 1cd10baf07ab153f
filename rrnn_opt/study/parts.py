"""Finished rows as Parquet part files, each written whole or not at all.

A part has the fields of a kept row, the metrics as JSON among them, and every
metric that is a number, text or list of numbers as a column of its own, so that

    duckdb -c "select avg(error_m) from 'DIR/rows/*.parquet'"

reads it.  This is the only file that imports pyarrow, which comes with the extra
``study``; without it rows stay in the journal.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from rrnn_opt.study.journal import FIELDS, Entry, intact


def available() -> bool:
    """Whether part files can be written and read here."""
    return find_spec("pyarrow") is not None


def write_part(path: Path, entries: Sequence[Entry]) -> Path:
    """Write entries as one part, under another name first.

    Args:
        path: of the part.
        entries: at least one.

    Raises:
        OSError: it cannot be written; no part of that name is left.
    """
    import pyarrow.parquet as pq

    waiting = path.with_suffix(".writing")
    try:
        with waiting.open("wb") as file:
            pq.write_table(_table(entries), file)
            file.flush()
            os.fsync(file.fileno())
        os.replace(waiting, path)
    except BaseException:
        waiting.unlink(missing_ok=True)
        raise
    return path


def read_part(path: Path) -> Iterator[dict[str, Any] | None]:
    """The entries of a part; None for one that is not intact.

    Raises:
        OSError: the file is no whole part: truncated, or overwritten, or its
            texts are none.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

    try:
        table = pq.read_table(path, columns=[*FIELDS, "check"])
    except (pa.ArrowException, OSError, KeyError) as error:
        raise OSError(f"{path}: {error}") from error
    for batch in table.to_batches(max_chunksize=1000):
        try:
            rows = batch.to_pylist()
        except UnicodeDecodeError as error:
            raise OSError(f"{path}: {error}") from error
        for row in rows:
            entry = _entry(row)
            yield entry if intact(entry) else None


def _entry(row: dict[str, Any]) -> dict[str, Any] | None:
    try:
        return {**row, "metrics": json.loads(row["metrics"])}
    except (TypeError, ValueError, RecursionError):
        return None


def _table(entries: Sequence[Entry]) -> Any:
    import pyarrow as pa

    columns: dict[str, list[Any]] = {
        name: [e[name] for e in entries] for name in (*FIELDS, "check")
    }
    columns["metrics"] = [json.dumps(e["metrics"]) for e in entries]
    for name in dict.fromkeys(k for e in entries for k in e["metrics"]):
        if name not in columns:
            columns[name] = [e["metrics"].get(name) for e in entries]
    arrays = {name: _column(values) for name, values in columns.items()}
    return pa.table(arrays)


def _column(values: list[Any]) -> Any:
    """A column of one type; of JSON texts where the values have several."""
    import pyarrow as pa

    if any(isinstance(value, dict) for value in values):
        return pa.array([json.dumps(v) for v in values], pa.string())
    try:
        return pa.array(values)
    except (pa.ArrowInvalid, pa.ArrowTypeError):
        return pa.array([json.dumps(v) for v in values], pa.string())
