"""A JSON document from a file, or one sentence that says why not."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from rrnn_opt.errors import DocumentError
from rrnn_opt.scene import fields

LARGEST_DOCUMENT = 64 * 2**20
"""Bytes that are read at most; a problem takes some thousands."""


def read_json(path: str | Path) -> Any:
    """The value that a JSON file holds.

    Numbers that JSON does not know (NaN, Infinity) come through as floats:
    whoever checks the fields names the one that holds them.

    Args:
        path: the file, UTF-8.

    Returns:
        The value.

    Raises:
        DocumentError: the file cannot be read, is not UTF-8, is no JSON (line
            and column), is nested too deeply, or repeats a key.
    """
    text = _text(path)
    try:
        return json.loads(text, object_pairs_hook=_Pairs(str(path)))
    except json.JSONDecodeError as error:
        message = f"line {error.lineno}, column {error.colno}: not JSON ({error.msg})"
        raise DocumentError(str(path), message) from None
    except RecursionError:
        raise DocumentError(str(path), "nested too deeply") from None
    except ValueError:  # an integer of thousands of digits
        raise DocumentError(str(path), "a number has too many digits") from None


def _text(path: str | Path) -> str:
    try:
        with open(path, "rb") as file:
            raw = file.read(LARGEST_DOCUMENT + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise DocumentError(str(path), f"cannot be read: {reason}") from None
    if len(raw) > LARGEST_DOCUMENT:
        message = f"larger than {LARGEST_DOCUMENT // 2**20} MiB"
        raise DocumentError(str(path), message)
    try:
        return raw.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        message = f"not UTF-8 text (byte {error.start})"
        raise DocumentError(str(path), message) from None


class _Pairs:
    """Builds objects and refuses a key that comes twice."""

    def __init__(self, path: str) -> None:
        self.path = path

    def __call__(self, pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        result = dict(pairs)
        if len(result) != len(pairs):
            keys = [key for key, _ in pairs]
            twice = next(key for key in keys if keys.count(key) > 1)
            message = f"the key {fields.shown(twice)} stands twice in one object"
            raise DocumentError(self.path, message)
        return result
