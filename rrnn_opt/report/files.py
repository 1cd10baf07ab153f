"""Files that appear whole or not at all."""

from __future__ import annotations

import contextlib
import hashlib
import os
import re
import tempfile
import time
from pathlib import Path

STALE = 3600.0
"""Age in seconds from which a temporary file is nobody's any more."""


def write_bytes(path: str | Path, data: bytes) -> Path:
    """Write a file under another name and move it into place.

    Args:
        path: file to write; its folder exists.
        data: what it shall hold.

    Returns:
        The path.

    Raises:
        OSError: it cannot be written; what stood there before is untouched
            and nothing half-written is left.
    """
    target = Path(path)
    try:
        _replace(target, data)
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(target)) from error
    return target


def _replace(target: Path, data: bytes) -> None:
    _sweep(target)
    handle, name = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.chmod(name, 0o666 & ~_umask())
        os.replace(name, target)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise


def write_text(path: str | Path, text: str) -> Path:
    """Write a UTF-8 file like ``write_bytes``.

    Args:
        path: file to write; it appears whole or not at all.
        text: what it will hold.

    Raises:
        OSError: as there.
    """
    return write_bytes(path, text.encode("utf-8", "replace"))


def _sweep(target: Path) -> None:
    """Remove what runs that were killed left of this file an hour ago or more."""
    name = re.compile(rf"\.{re.escape(target.name)}\.[a-z0-9_]{{8}}")
    with contextlib.suppress(OSError), os.scandir(target.parent) as found:
        for entry in found:
            if name.fullmatch(entry.name):
                with contextlib.suppress(OSError):
                    if time.time() - entry.stat().st_mtime > STALE:
                        os.unlink(entry)


def file_name(name: str) -> str:
    """A name of the user's as the stem of a file: no path, and not too long."""
    plain = re.sub(r"[^A-Za-z0-9_.+-]", "_", name).strip(".")[:80]
    if plain and plain == name:
        return name
    return f"{plain}_{hashlib.sha256(name.encode('utf-8', 'replace')).hexdigest()[:8]}"


def _umask() -> int:
    """The permission bits that this process withholds from new files."""
    mask = os.umask(0o022)
    os.umask(mask)
    return mask
