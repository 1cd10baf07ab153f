"""What all tests rely on."""

import signal
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from tests.docstrings import House
from tests.syntax import read_house

settings.register_profile(
    "steady",
    deadline=None,
    derandomize=True,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("steady")
"""Laws hold on the same examples everywhere, however busy the machine is."""


@pytest.fixture(scope="session")
def sources():
    """Text of every module of the package, by dotted name."""
    return read_house(Path(__file__).parents[1] / "rrnn_opt")


@pytest.fixture(scope="session")
def house(sources):
    """The same as syntax trees; parsing costs as much as all that is asked of them."""
    return House(sources)


@pytest.fixture(scope="session", autouse=True)
def _interruptible():
    """Commands of the tests can be interrupted, also where the shell that started
    pytest ignores SIGINT (as it does for a job in the background)."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture(scope="session", autouse=True)
def _compiled(request, tmp_path_factory):
    """All workers and later sessions share what is compiled, apart from the user's.

    An entry's name holds the hash of its source, flags, compiler and CPU, so none
    is ever out of date; tests of the cache itself take folders of their own.
    """
    kept = getattr(request.config, "cache", None)  # none with -p no:cacheprovider
    folder = kept.mkdir("compiled") if kept else tmp_path_factory.mktemp("compiled")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("RRNN_CACHE_DIR", str(folder))
        yield
