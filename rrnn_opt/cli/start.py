"""The program ``rrnn``: Ctrl-C before and after the command leaves no traceback."""

from __future__ import annotations

import signal
import sys


def main() -> int:
    """Load and run the command line; the exit status."""
    try:
        from rrnn_opt.cli.main import main as run

        code = run()
    except KeyboardInterrupt:
        print("rrnn: interrupted", file=sys.stderr)
        code = 130
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    return code


if __name__ == "__main__":
    sys.exit(main())
