"""Runs that were killed, or filled a disk, are taken up; and what rows cost."""

import signal
import time
import tracemalloc

import pytest

from rrnn_opt.study import Results, table
from tests.study.interruptions import start
from tests.study.test_results import whole


def test_a_full_disk_keeps_what_was_finished(studies, tmp_path):
    """A limit on the file's size ends a write in the middle of a line."""
    process = start(tmp_path, limit=3000)
    said, error = process.communicate(timeout=60)
    assert process.returncode == 1
    assert "OSError" in error
    done = said.split()
    assert 2 < len(done) < 40
    with Results(tmp_path) as results:
        assert [r.key for r in results.rows(studies.Draws(40))] == done
        resumed = table(results.finish(studies.Draws(40)))
    assert resumed == whole(studies.Draws(40), tmp_path / "whole")


@pytest.mark.parametrize("how", [signal.SIGKILL, signal.SIGINT])
def test_a_killed_run_is_taken_up(studies, tmp_path, how):
    process = start(tmp_path, wait_s=0.02)
    for _ in range(4):
        process.stdout.readline()
    process.send_signal(how)
    process.communicate(timeout=60)
    with Results(tmp_path) as results:
        before = len(results.rows(studies.Draws(40)))
        assert 4 <= before < 40
        left = sum(1 for _ in results.run(studies.Draws(40)))
        assert left == 40 - before
        assert table(results.rows(studies.Draws(40))) == whole(
            studies.Draws(40), tmp_path / "whole"
        )


@pytest.mark.slow
def test_memory_does_not_grow_with_the_rows(studies, tmp_path):
    """What is added for a row is a digest, not the row; 100 thousand: the soak."""
    peaks = []
    for count in (2000, 6000):
        tracemalloc.start()
        with Results(tmp_path / str(count)) as results:
            assert sum(1 for _ in results.run(studies.Draws(count))) == count
            peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
    assert peaks[1] - peaks[0] < 4000 * 200


@pytest.mark.slow
def test_the_engine_costs_less_than_two_per_cent_of_cases_of_50_ms(studies, tmp_path):
    """CPU time of the engine itself: the cases sleep."""
    with Results(tmp_path) as results:
        began = time.process_time()
        rows = results.finish(studies.Draws(100, wait_s=0.05))
        spent = time.process_time() - began
    assert len(rows) == 100
    assert spent < 0.02 * 100 * 0.05
