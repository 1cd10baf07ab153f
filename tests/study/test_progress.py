import io

import pytest

from rrnn_opt.study import Progress, environment, one_thread
from rrnn_opt.study import progress as module


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.fixture
def clock(monkeypatch):
    now = [100.0]
    monkeypatch.setattr(module.time, "monotonic", lambda: now[0])
    return now


def test_rate_and_time_left(clock):
    screen = Terminal()
    show = Progress(screen, label="compare ")
    show(10, 100)
    clock[0] += 5.0
    show(20, 100)
    assert screen.getvalue().endswith("compare 20/100  2/s, 0:40 left")
    show.close()
    assert screen.getvalue().endswith("\r\x1b[K")


def test_a_line_a_minute_where_nobody_watches(clock):
    log = io.StringIO()
    show = Progress(log, label="compare ")
    for finished in range(1, 31):
        clock[0] += 5.0
        show(finished, 120)
    show.close()
    first, second = log.getvalue().splitlines()
    assert first.startswith("compare 12/120  ")
    assert first.endswith(" left")
    assert second.startswith("compare 24/120  ")


def test_a_short_study_writes_no_line_into_a_log(clock):
    log = io.StringIO()
    show = Progress(log)
    clock[0] += 5.0
    show(1, 2)
    show(2, 2)
    show.close()
    assert log.getvalue() == ""


def test_a_log_that_nobody_reads_stops_no_study(clock):
    class Closed(io.StringIO):
        def write(self, text):
            raise BrokenPipeError

    show = Progress(Closed())
    clock[0] += 100.0
    show(1, 2)
    show.close()


def test_environment_says_where_and_how(monkeypatch):
    import json

    found = environment({"jobs": 2}, packages=("numpy", "no-such-package"))
    assert json.loads(json.dumps(found)) == found
    assert set(found["versions"]) == {"rrnn_opt", "numpy"}
    assert found["settings"] == {"jobs": 2}
    assert found["cores"] >= 1


def test_one_thread_is_taken_back(monkeypatch):
    import os

    monkeypatch.setenv("OMP_NUM_THREADS", "5")
    monkeypatch.delenv("MKL_NUM_THREADS", raising=False)
    with one_thread():
        assert os.environ["OMP_NUM_THREADS"] == os.environ["MKL_NUM_THREADS"] == "1"
    assert os.environ["OMP_NUM_THREADS"] == "5"
    assert "MKL_NUM_THREADS" not in os.environ
