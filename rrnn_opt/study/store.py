"""A folder of finished rows: a journal, folded into Parquet parts as it grows."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from rrnn_opt.errors import RrnnError
from rrnn_opt.study import parts
from rrnn_opt.study.journal import Entry, Journal

FOLD = 2000
"""Rows in the journal from which a part is made."""


class StoreError(RrnnError):
    """A folder of rows cannot be used.

    Attributes:
        folder: which one.
    """

    def __init__(self, folder: Path, message: str) -> None:
        self.folder = folder
        super().__init__(f"{folder}: {message}")


class Store:
    """Finished rows in a folder; one writer at a time.

    Args:
        folder: made where it is missing.

    Attributes:
        folder: the same.
        damaged: rows and parts that were found broken and do not count.

    Raises:
        StoreError: another run writes there.
        OSError: the folder cannot be written.
    """

    def __init__(self, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self.folder, self.damaged = folder, 0
        self._lock = _locked(folder)
        self._journal = Journal(folder / "journal.jsonl")
        self._length = sum(1 for _ in self._journal)

    def __enter__(self) -> Store:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __iter__(self) -> Iterator[dict[str, Any]]:
        """Every intact entry, one at a time; an entry kept twice comes once."""
        self.damaged, seen = 0, set()
        for entry in self._entries():
            mark = bytes.fromhex(entry["identity"])
            if mark not in seen:
                seen.add(mark)
                yield entry

    def append(self, entry: Entry) -> None:
        """Keep one row.

        Raises:
            OSError: the disk is full, say; all rows before are kept.
        """
        self._journal.append(entry)
        self._length += 1
        if self._length >= FOLD:
            self.fold()

    def fold(self) -> None:
        """Make a part of the journal; without pyarrow nothing happens."""
        if self._length == 0 or not parts.available():
            return
        entries = list(self._journal)
        if entries:
            parts.write_part(self._next(), entries)
        self._journal.clear()
        self._length = 0

    def close(self) -> None:
        """Fold the journal and let others write here.

        A part that cannot be written, on a full disk say, leaves the journal.
        """
        with contextlib.suppress(OSError):
            self.fold()
        if self._lock is not None:
            os.close(self._lock)
            self._lock = None

    def _entries(self) -> Iterator[dict[str, Any]]:
        for path in self._parts():
            if not parts.available():
                raise StoreError(
                    self.folder, "its rows are Parquet: install rrnn_opt[study]"
                )
            try:
                for entry in parts.read_part(path):
                    if entry is None:
                        self.damaged += 1
                    else:
                        yield entry
            except OSError:
                self.damaged += 1
        yield from self._journal
        self.damaged += self._journal.damaged

    def _parts(self) -> list[Path]:
        return sorted(self.folder.glob("part-*.parquet"))

    def _next(self) -> Path:
        names = [path.stem.removeprefix("part-") for path in self._parts()]
        numbers = [int(name) for name in names if name.isdecimal()]
        return self.folder / f"part-{max(numbers, default=0) + 1:06d}.parquet"


def set_aside(folder: Path) -> None:
    """Put the rows of an earlier run under the name "<folder>.before".

    What stood there before is lost: one earlier run is kept, not all.
    """
    import shutil

    if not folder.exists():
        return
    before = folder.with_name(f"{folder.name}.before")
    shutil.rmtree(before, ignore_errors=True)
    folder.rename(before)


def _locked(folder: Path) -> int | None:
    """A lock that ends with the process; None where there are no such locks."""
    try:
        import fcntl
    except ImportError:
        return None
    handle = os.open(folder / ".lock", os.O_RDWR | os.O_CREAT, 0o666)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        os.close(handle)
        message = "another run writes there; wait for it or name another folder"
        raise StoreError(folder, message) from error
    return handle
