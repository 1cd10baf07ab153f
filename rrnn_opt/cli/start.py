"""The program ``rrnn``: Ctrl-C before and after the command leaves no traceback."""

from __future__ import annotations

import os
import signal
import sys


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


def settle_interrupt() -> None:
    """Let the exit status of an interrupted command stand.

    Where code that a C library ran was interrupted, CPython ends the process by SIGINT
    even if the interrupt was handled (``unhandled_keyboard_interrupt``); it forgets
    that when other such code comes to its end.
    """
    import ctypes

    ctypes.pythonapi.PyRun_SimpleString(b"pass")


def main() -> int:
    """Load and run the command line; the exit status."""
    fill_streams()
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
    if code > 128:
        settle_interrupt()
    return code


if __name__ == "__main__":
    sys.exit(main())
