"""``python -m benchmarks.soak``: see :mod:`benchmarks.soak.run`."""

import sys

from benchmarks.soak.run import main

if __name__ == "__main__":
    sys.exit(main())
