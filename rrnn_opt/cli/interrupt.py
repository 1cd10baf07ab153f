"""Ctrl-C and other requests to end: noticed always, held while a result is written."""

from __future__ import annotations

import contextlib
import signal
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from types import FrameType

ENDING = ("SIGINT", "SIGTERM", "SIGHUP")
"""Signals that ask a command to end; the last one comes from a closing terminal."""
Handler = Callable[[int, FrameType | None], None]


@dataclass
class Interrupt:
    """What asked the command to end since it began.

    Attributes:
        number: of the signal; 0 where there was none.
    """

    number: int = 0

    @property
    def seen(self) -> bool:
        """Whether there was one."""
        return self.number != 0

    @property
    def status(self) -> int:
        """Exit status as shells count it: 130 after Ctrl-C, 143 after SIGTERM."""
        return 128 + (self.number or signal.SIGINT)

    @property
    def sentence(self) -> str:
        """What is said of it."""
        if self.number in (0, signal.SIGINT):
            return "interrupted"
        return f"interrupted by {signal.Signals(self.number).name}"


@contextlib.contextmanager
def noticed() -> Iterator[Interrupt]:
    """Remember Ctrl-C, which raises ``KeyboardInterrupt`` as ever; so do the others.

    An import or a callback from C may swallow the exception or turn it into
    another one; the exit status is still that of an interrupted run.

    Raises:
        KeyboardInterrupt: at Ctrl-C, SIGTERM or SIGHUP.
    """
    interrupt = Interrupt()

    def remember(number: int, frame: FrameType | None) -> None:
        interrupt.number = interrupt.number or number
        raise KeyboardInterrupt

    with _handling(remember):
        yield interrupt


@contextlib.contextmanager
def held() -> Iterator[None]:
    """Let a first request to end wait until the block is done; not a second one.

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
def _handling(handler: Handler) -> Iterator[None]:
    """Another handler for a while; only the main thread has one.

    What is ignored stays so: ``nohup`` and shells' background jobs ask for it.
    """
    with contextlib.ExitStack() as stack:
        if threading.current_thread() is threading.main_thread():
            for name in ENDING:
                number = getattr(signal, name, None)
                if number is None:
                    continue
                before = signal.getsignal(number)
                if before not in (None, signal.SIG_IGN):
                    stack.callback(signal.signal, number, before)
                    signal.signal(number, handler)
        yield
