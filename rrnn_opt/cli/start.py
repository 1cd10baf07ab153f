"""The program ``rrnn``: Ctrl-C before and after the command leaves no traceback."""

from __future__ import annotations

import atexit
import contextlib
import os
import signal
import sys
from dataclasses import dataclass


def fill_streams() -> None:
    """Let what is said to a closed stream go nowhere.

    Otherwise the next file that is opened gets its number, and what a C library
    prints would end up in that file.
    """
    for number, name in enumerate(("stdin", "stdout", "stderr")):
        if getattr(sys, name) is None:
            handle = os.open(os.devnull, os.O_RDWR)  # the lowest number: this one
            stream = os.fdopen(handle, "w" if number else "r", encoding="utf-8")
            setattr(sys, name, stream)


@dataclass
class Ending:
    """The end of the process, after all that others do at its exit.

    Where code that a C library ran was interrupted, CPython ends the process by SIGINT
    even if the interrupt was handled (``unhandled_keyboard_interrupt``).

    Attributes:
        status: to leave with if a signal asked for the end; 0 if none did.
    """

    status: int = 0

    def __call__(self) -> None:
        """Leave with the status of the signal; threads and pools have ended by now."""
        if self.status > 128:
            for stream in (sys.stdout, sys.stderr):
                with contextlib.suppress(OSError, ValueError):
                    stream.flush()
            os._exit(self.status)


def main() -> int:
    """Load and run the command line; the exit status."""
    fill_streams()
    ending = Ending()
    atexit.register(ending)  # the first to be registered is the last to be called
    loaded = False
    try:
        from rrnn_opt.cli.main import main as run

        loaded = True
        code = run()
    except KeyboardInterrupt:
        if "--json" in sys.argv and not loaded:
            print('{"error": {"kind": "interrupted", "message": "interrupted"}}')
        print("rrnn: interrupted", file=sys.stderr)
        code = 130
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    ending.status = code
    return code


if __name__ == "__main__":
    sys.exit(main())
