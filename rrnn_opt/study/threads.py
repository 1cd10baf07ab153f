"""One thread a process: numerical libraries must not fight over the cores."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager

VARIABLES = (
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "BLIS_NUM_THREADS",
    "NUMEXPR_NUM_THREADS",
    "VECLIB_MAXIMUM_THREADS",
)


@contextmanager
def one_thread() -> Iterator[None]:
    """What is started inside computes with one thread.

    Libraries read these variables when they are loaded: a process started
    inside obeys, one that has loaded them does not.
    """
    before = {name: os.environ.get(name) for name in VARIABLES}
    pin_threads()
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value


def pin_threads() -> None:
    """Ask for one thread in this process; of use before NumPy is loaded."""
    os.environ.update(dict.fromkeys(VARIABLES, "1"))
