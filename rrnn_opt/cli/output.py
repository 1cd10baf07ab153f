"""What goes where: results to standard output, all talk to standard error."""

from __future__ import annotations

import contextlib
import json
import os
import sys
from collections.abc import Iterator
from typing import Any

from rrnn_opt.cli.interrupt import held
from rrnn_opt.errors import RrnnError


class UsageError(RrnnError):
    """The command line itself is wrong."""


def _printable(text: str, stream: Any) -> str:
    """Text that a terminal takes: names may hold letters that it lacks, or halves."""
    code = getattr(stream, "encoding", None) or "utf-8"
    return text.encode(code, "backslashreplace").decode(code)


class Output:
    """Where a command puts its results.

    With ``--json`` the only thing on standard output is one document: the file
    descriptor itself points to standard error while the command runs, so that
    not even a C library can put a line between.

    Args:
        as_json: whether ``--json`` was given.
        descriptor: file descriptor of the real standard output.

    Attributes:
        as_json: whether ``--json`` was given.
        done: whether the document has been printed.
    """

    def __init__(self, as_json: bool, descriptor: int) -> None:
        self.as_json = as_json
        self.done = False
        self._descriptor = descriptor

    def say(self, text: str = "") -> None:
        """A line for people; with ``--json`` it goes to standard error."""
        try:
            print(_printable(text, sys.stdout), flush=True)
        except BrokenPipeError:
            silence(1)

    def note(self, text: str) -> None:
        """A line about the run itself, always to standard error."""
        with contextlib.suppress(OSError):
            print(_printable(text, sys.stderr), file=sys.stderr, flush=True)

    def document(self, document: dict[str, Any]) -> None:
        """The result as JSON, whole; nothing happens without ``--json``.

        Raises:
            ValueError: it holds NaN or an infinity.
            OSError: standard output cannot be written.
        """
        if not self.as_json or self.done:
            return
        data = (json.dumps(document, allow_nan=False) + "\n").encode()
        with held():
            self.done = True
            try:
                while data:
                    data = data[os.write(self._descriptor, data) :]
            except BrokenPipeError:
                silence(self._descriptor)


def silence(descriptor: int) -> None:
    """Send what follows nowhere: its reader has left, but the work goes on."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, descriptor)
    os.close(nowhere)


@contextlib.contextmanager
def opened(as_json: bool) -> Iterator[Output]:
    """The output of one command; streams are as before afterwards."""
    if not as_json:
        yield Output(False, sys.__stdout__.fileno() if sys.__stdout__ else 1)
        return
    sys.stdout.flush()
    kept = os.dup(1)
    os.dup2(2, 1)
    try:
        with contextlib.redirect_stdout(sys.stderr):
            yield Output(True, kept)
    finally:
        with contextlib.suppress(OSError):
            sys.stdout.flush()
        os.dup2(kept, 1)
        os.close(kept)
