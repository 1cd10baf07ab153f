"""The program ``rrnn``: Ctrl-C before and after the command leaves no traceback."""

from __future__ import annotations

import signal
import sys


def main() -> int:
    """Load and run the command line; the exit status."""
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
