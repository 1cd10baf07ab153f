"""JSON objects as lines of a file that only grows: a kill may take the last one."""

from __future__ import annotations

import contextlib
import errno
import json
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any


def read_lines(path: Path) -> Iterator[dict[str, Any] | None]:
    """The objects of a file, in order; None for a line that is no JSON object.

    A file that is not there has no lines.
    """
    if not path.exists():
        return
    with path.open(encoding="utf-8", errors="replace") as lines:
        for line in lines:
            try:
                entry = json.loads(line)
            except (ValueError, RecursionError):
                entry = None
            yield entry if isinstance(entry, dict) else None


class Lines:
    """A file of JSON objects with one writer; what a kill cut off is cut away.

    Without that the next line would be glued to the torn one, and both be lost.

    Args:
        path: of the file; made when the first line is written.

    Attributes:
        path: the same.
        damaged: lines that the last iteration found broken.

    Raises:
        OSError: the file is a link: what it points to is not ours to cut.
    """

    def __init__(self, path: Path) -> None:
        self.path, self.damaged = path, 0
        _cut_last_line(path)

    def __iter__(self) -> Iterator[dict[str, Any]]:
        """The whole entries, in the order in which they were written."""
        self.damaged = 0
        for entry in read_lines(self.path):
            if entry is not None and self.accepts(entry):
                yield entry
            else:
                self.damaged += 1

    def accepts(self, entry: Mapping[str, Any]) -> bool:
        """Whether an entry counts; subclasses may ask for more."""
        return True

    def append(self, entry: Mapping[str, Any]) -> None:
        """Write one entry and hand it to the system.

        Raises:
            OSError: the disk is full, say; what was written before is kept, and
                nothing of this entry.
        """
        data = (json.dumps(entry) + "\n").encode()
        ways = os.O_WRONLY | os.O_APPEND | os.O_CREAT | os.O_NOFOLLOW
        handle = os.open(self.path, ways, 0o666)
        try:
            before = os.fstat(handle).st_size
            try:
                while data:
                    data = data[os.write(handle, data) :]
            except OSError:
                with contextlib.suppress(OSError):
                    os.ftruncate(handle, before)
                raise
        finally:
            os.close(handle)

    def clear(self) -> None:
        """Forget all entries: they are kept elsewhere."""
        self.path.unlink(missing_ok=True)


def _cut_last_line(path: Path) -> None:
    """Remove what follows the last end of a line."""
    if path.is_symlink():
        raise OSError(errno.ELOOP, "a link is not written through", str(path))
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
