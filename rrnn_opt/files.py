"""Reading what a user's file holds: every room reads through here.

A file is read whole and at most so many bytes of it; devices, pipes and folders
are no files.  JSON is nested at most as deep as Python's reader goes, and no key
stands twice in one object.
"""

from __future__ import annotations

import json
import os
import runpy
import stat
from collections.abc import Callable
from pathlib import Path
from typing import Any

from rrnn_opt.errors import DocumentError

LARGEST_DOCUMENT = 64 * 2**20
"""Bytes of a document that are read at most; a problem takes some thousands."""
_SHOWN = 200


def read_bytes(path: str | Path, *, most: int = LARGEST_DOCUMENT) -> bytes:
    """All bytes of a regular file.

    Args:
        path: the file.
        most: size from which it is refused, bytes.

    Returns:
        What it holds.

    Raises:
        DocumentError: there is no such file, it is a folder, pipe or device,
            cannot be read, or is larger.
    """
    where = shown_path(path)
    try:
        # a pipe without a writer would be waited for
        handle = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0))
        with os.fdopen(handle, "rb") as file:
            if not stat.S_ISREG(os.fstat(handle).st_mode):
                raise DocumentError(where, "cannot be read: it is no file")
            raw = file.read(most + 1)
    except (OSError, ValueError, TypeError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise DocumentError(where, f"cannot be read: {reason}") from None
    if len(raw) > most:
        raise DocumentError(where, f"larger than {most // 2**20} MiB")
    return raw


def read_text(path: str | Path, *, most: int = LARGEST_DOCUMENT) -> str:
    """The text of a UTF-8 file.

    Args:
        path: the file.
        most: size from which it is refused, bytes.

    Raises:
        DocumentError: as for ``read_bytes``, or it is not UTF-8.
    """
    try:
        return read_bytes(path, most=most).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        message = f"not UTF-8 text (byte {error.start})"
        raise DocumentError(shown_path(path), message) from None


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
    text, where = read_text(path), shown_path(path)
    try:
        return json.loads(text, object_pairs_hook=_Pairs(where))
    except json.JSONDecodeError as error:
        message = f"line {error.lineno}, column {error.colno}: not JSON ({error.msg})"
        raise DocumentError(where, message) from None
    except RecursionError:
        raise DocumentError(where, "nested too deeply") from None
    except ValueError:  # an integer of thousands of digits
        raise DocumentError(where, "a number has too many digits") from None


def from_python(path: str | Path, function: str) -> list[Any]:
    """What a function of a user's Python file gives, as a list.

    The file is the user's own program and is run; what it raises is said in one
    sentence with its line.

    Args:
        path: the file.
        function: without arguments; gives an iterable.

    Raises:
        DocumentError: the file cannot be read or fails, or there is no such
            function, or it gives nothing to iterate over.
    """
    where, _ = shown_path(path), read_bytes(path)
    room = _guarded(lambda: runpy.run_path(str(path)), where)
    made = room.get(function)
    if not callable(made):
        raise DocumentError(where, f"defines no function {function}()")
    return list(_guarded(lambda: list(made()), where))


def _guarded(call: Callable[[], Any], where: str) -> Any:
    """The result of a user's code."""
    try:
        return call()
    except KeyboardInterrupt:
        raise
    except BaseException as error:
        line = _line(error, where)
        reason = " ".join(f"{type(error).__name__}: {error}".split())[:_SHOWN]
        raise DocumentError(where, f"fails{line} ({reason})") from error


def _line(error: BaseException, where: str) -> str:
    """The line of the user's file that raised, in words."""
    place, found = error.__traceback__, ""
    while place is not None:
        if place.tb_frame.f_code.co_filename == where:
            found = f" in line {place.tb_lineno}"
        place = place.tb_next
    return found


def shown_path(path: object) -> str:
    """A path for a message: one line of at most ``_SHOWN`` characters."""
    text = os.fspath(path) if isinstance(path, str | os.PathLike) else repr(path)
    if not isinstance(text, str) or not text.isprintable():
        text = ascii(text)[1:-1]
    return text if len(text) <= _SHOWN else "..." + text[3 - _SHOWN :]


class _Pairs:
    """Builds objects and refuses a key that comes twice."""

    def __init__(self, path: str) -> None:
        self.path = path

    def __call__(self, pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        result = dict(pairs)
        if len(result) != len(pairs):
            keys = [key for key, _ in pairs]
            twice = next(key for key in keys if keys.count(key) > 1)
            message = f"the key {ascii(twice)[:40]} stands twice in one object"
            raise DocumentError(self.path, message)
        return result
