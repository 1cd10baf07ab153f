"""A forked process, for tests of what ends in one."""

import os
import signal
import warnings


def forked(work, *, limit_s=60):
    """Number of a forked process that does ``work`` and ends: 0 if it could.

    A library's threads may be running: that is part of what is tried.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        child = os.fork()
    if child == 0:
        status = 1
        try:
            signal.alarm(limit_s)
            work()
            status = 0
        finally:
            os._exit(status)
    return child


def ended(child):
    """Exit status of a forked process; negative, the signal that ended it."""
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
