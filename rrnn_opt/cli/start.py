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
    return code


if __name__ == "__main__":
    sys.exit(main())
