"""Finished rows as lines of text: what a power cut may take is the last line."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

FIELDS = ("identity", "study", "key", "seed", "error", "time_s", "metrics")
"""What a kept row holds; ``check`` is a digest of all but ``time_s``."""

Entry = Mapping[str, Any]


def sealed(entry: Mapping[str, Any]) -> dict[str, Any]:
    """The entry with its digest."""
    return {**entry, "check": _digest(entry)}


def intact(entry: Any) -> bool:
    """Whether an entry has all its fields and they give its digest."""
    if not isinstance(entry, dict) or not {*FIELDS, "check"} <= set(entry):
        return False
    return bool(entry["check"] == _digest(entry))


def _digest(entry: Mapping[str, Any]) -> str:
    parts = [entry[name] for name in FIELDS if name != "time_s"]
    return hashlib.sha256(json.dumps(parts).encode()).hexdigest()[:16]


class Journal:
    """A file of JSON lines that only grows; a line cut off is cut away.

    Args:
        path: of the file; made when the first line is written.

    Attributes:
        damaged: lines that are no intact entries.
    """

    def __init__(self, path: Path) -> None:
        self.path, self.damaged = path, 0
        _cut_last_line(path)

    def __iter__(self) -> Iterator[dict[str, Any]]:
        """The intact entries, in the order in which they were finished."""
        self.damaged = 0
        if not self.path.exists():
            return
        with self.path.open(encoding="utf-8", errors="replace") as lines:
            for line in lines:
                try:
                    entry = json.loads(line)
                except json.JSONDecodeError:
                    entry = None
                if intact(entry):
                    yield entry
                else:
                    self.damaged += 1

    def append(self, entry: Entry) -> None:
        """Write one entry and hand it to the system.

        Raises:
            OSError: the disk is full, say; what was written before is kept.
        """
        data = (json.dumps(entry) + "\n").encode()
        handle = os.open(self.path, os.O_WRONLY | os.O_APPEND | os.O_CREAT, 0o666)
        try:
            while data:
                data = data[os.write(handle, data) :]
        finally:
            os.close(handle)

    def clear(self) -> None:
        """Forget all entries: they are kept elsewhere."""
        self.path.unlink(missing_ok=True)


def _cut_last_line(path: Path) -> None:
    """Remove what follows the last end of a line."""
    if not path.exists():
        return
    with path.open("rb+") as file:
        end = file.seek(0, os.SEEK_END)
        while end > 0:
            start = max(0, end - 65536)
            file.seek(start)
            place = file.read(end - start).rfind(b"\n")
            if place >= 0:
                file.truncate(start + place + 1)
                return
            end = start
        file.truncate(0)
