"""The folder that ``--out`` names, looked at before the work starts."""

from __future__ import annotations

import errno
import os
import tempfile
from pathlib import Path

from rrnn_opt.cli.output import UsageError

FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
"""Errors of a disk that holds no more, or may not."""


def folder(path: str) -> Path:
    """The folder, made if it is missing, after a trial file in it.

    Raises:
        UsageError: nothing can be written there.
    """
    target = Path(path)
    try:
        target.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=target) as trial:
            trial.write(b"rrnn")
    except OSError as error:
        reason = error.strerror or str(error)
        raise UsageError(f"--out {path}: cannot be written ({reason})") from error
    return target


def os_sentence(error: OSError) -> str:
    """An operating system's error as one sentence."""
    reason = error.strerror or str(error) or type(error).__name__
    if error.errno in FULL:
        reason += "; free some room, or name a folder on another disk"
    return f"{os.fspath(error.filename)}: {reason}" if error.filename else reason
