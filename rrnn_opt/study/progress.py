"""How far a study is, on a terminal or in a log."""

from __future__ import annotations

import contextlib
import time
from typing import TextIO

EVERY_S = 0.2
"""Seconds between two lines on a terminal, s."""
LOGGED_S = 60.0
"""Seconds between two lines in a file or a pipe, s."""


class Progress:
    """One line that is written over; where nobody watches, a line a minute.

    Args:
        stream: standard error.
        label: before the numbers.
    """

    def __init__(self, stream: TextIO, *, label: str = "") -> None:
        self._stream, self._label = stream, label
        self._seen = stream.isatty()
        self._began = self._last = time.monotonic()
        self._first: int | None = None

    def __call__(self, finished: int, total: int) -> None:
        """Show the count, the rate and the time left.

        Args:
            finished: cases, those of an earlier run included.
            total: cases in all.
        """
        if self._first is None:
            self._first = finished
        now = time.monotonic()
        soon = now - self._last < (EVERY_S if self._seen else LOGGED_S)
        if soon and not (self._seen and finished == total):
            return
        self._last = now
        rate = (finished - self._first) / max(now - self._began, 1e-9)
        self._write(f"{self._label}{finished}/{total}{_rest(rate, total - finished)}")

    def close(self) -> None:
        """Take the line away; lines of a log stay."""
        if self._seen:
            self._write("")

    def _write(self, text: str) -> None:
        with contextlib.suppress(OSError):  # nobody reads: the study goes on
            self._stream.write(f"\r\x1b[K{text}" if self._seen else f"{text}\n")
            self._stream.flush()


def _rest(rate: float, left: int) -> str:
    """Rate and time left, once there is a rate."""
    if rate <= 0.0:
        return ""
    minutes, seconds = divmod(round(left / rate), 60)
    return f"  {rate:.3g}/s, {minutes}:{seconds:02d} left"
