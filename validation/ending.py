"""How a study run as a program ends: bad input and full disks are one sentence."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable

from rrnn_opt.errors import RrnnError

BAD_INPUT, INTERRUPTED = 2, 130


def ended(main: Callable[[], object]) -> int:
    """Run a program's ``main``.

    Args:
        main: reads the arguments of the process; gives its exit
            status; what is no whole number counts as 0.

    Returns:
        The exit status: that of ``main``, 2 after a sentence on what is wrong with
        the input or a folder, 130 when interrupted: finished rows are kept then.
    """
    try:
        done = main()
        return done if isinstance(done, int) else 0
    except RrnnError as error:
        return _told(str(error), BAD_INPUT)
    except OSError as error:
        where = f"{os.fsdecode(error.filename)}: " if error.filename else ""
        return _told(f"{where}{error.strerror or error}", BAD_INPUT)
    except KeyboardInterrupt:
        return _told("interrupted", INTERRUPTED)


def _told(text: str, code: int) -> int:
    print(" ".join(text.split()), file=sys.stderr)
    return code
