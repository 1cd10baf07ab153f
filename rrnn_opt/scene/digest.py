"""Digests of the files that a problem refers to."""

from __future__ import annotations

import hashlib
from pathlib import Path

from rrnn_opt.errors import ProblemError


def sha256(path: Path, stated: str, field: str = "sha256") -> str:
    """SHA-256 of a file, in hexadecimal.

    Args:
        path: the file.
        stated: what it should be, or "".
        field: name of the field, for messages.

    Raises:
        ProblemError: it is another one than stated.
    """
    found = hashlib.sha256(path.read_bytes()).hexdigest()
    if stated and stated != found:
        raise ProblemError(field, f"{path.name} is not the file that it was")
    return found
