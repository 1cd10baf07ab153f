"""Ctrl-C: noticed where a library swallows it, held while a result is written."""

from __future__ import annotations

import contextlib
import signal
import threading
from collections.abc import Iterator
from dataclasses import dataclass
from types import FrameType


@dataclass
class Interrupt:
    """Whether Ctrl-C was pressed since the command began."""

    seen: bool = False


@contextlib.contextmanager
def noticed() -> Iterator[Interrupt]:
    """Remember Ctrl-C, which raises ``KeyboardInterrupt`` as ever.

    An import or a callback from C may swallow the exception or turn it into
    another one; the exit status is still that of an interrupted run.

    Raises:
        KeyboardInterrupt: at Ctrl-C.
    """
    interrupt = Interrupt()

    def remember(number: int, frame: FrameType | None) -> None:
        interrupt.seen = True
        raise KeyboardInterrupt

    with _handling(remember):
        yield interrupt


@contextlib.contextmanager
def held() -> Iterator[None]:
    """Let a first Ctrl-C wait until the block is done; a second one does not.

    Raises:
        KeyboardInterrupt: at the second Ctrl-C.
    """
    waiting: list[int] = []

    def wait(number: int, frame: FrameType | None) -> None:
        if waiting:
            raise KeyboardInterrupt
        waiting.append(number)

    with _handling(wait):
        yield
    if waiting:
        signal.raise_signal(waiting[0])


@contextlib.contextmanager
def _handling(handler: object) -> Iterator[None]:
    """Another handler of Ctrl-C for a while; only the main thread has one."""
    before = signal.getsignal(signal.SIGINT)
    main = threading.current_thread() is threading.main_thread()
    if not main or not callable(before):
        yield
        return
    signal.signal(signal.SIGINT, handler)  # type: ignore[arg-type]
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
