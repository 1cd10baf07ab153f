"""What all tests rely on."""

import signal

import pytest


@pytest.fixture(scope="session", autouse=True)
def _interruptible():
    """Commands of the tests can be interrupted, also where the shell that started
    pytest ignores SIGINT (as it does for a job in the background)."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)
