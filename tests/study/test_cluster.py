"""A Dask cluster: in this process tree, and as separate programs that are killed."""

import contextlib
import json
import os
import signal
import subprocess
import sys
import time

import pytest

from rrnn_opt.study import Cluster, Results, WorkerError, table

distributed = pytest.importorskip("distributed", reason="distributed is not installed")

pytestmark = [
    pytest.mark.slow,
    # sockets and loops that the cluster's own shutdown leaves to the collector
    pytest.mark.filterwarnings("ignore::ResourceWarning"),
    pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning"),
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),
    pytest.mark.filterwarnings("ignore::UserWarning"),
]


def alone(study, folder):
    with Results(folder) as results:
        return table(results.finish(study))


def test_a_local_cluster_gives_the_rows_of_one_process(studies, tmp_path):
    study = studies.Draws(25)
    options = {"n_workers": 2, "threads_per_worker": 1, "dashboard_address": None}
    with (
        distributed.LocalCluster(**options) as cluster,
        Results(tmp_path / "dask") as results,
    ):
        rows = results.finish(study, workers=Cluster(cluster.scheduler_address))
    assert {r.metrics["pid_us"] for r in rows}.isdisjoint({os.getpid()})
    found = table(rows)
    assert found == alone(study, tmp_path / "alone")


def test_several_threads_in_a_worker_are_refused(studies):
    options = {"n_workers": 1, "threads_per_worker": 2, "processes": False}
    with distributed.LocalCluster(dashboard_address=None, **options) as cluster:
        workers = Cluster(cluster.scheduler_address)
        study = studies.Draws(2)
        with pytest.raises(WorkerError, match="--nthreads 1"):
            list(workers.rows(study, iter(study), 0))


@contextlib.contextmanager
def programs(folder):
    """A scheduler and two workers, each a process of its own; address and workers."""
    file = folder / "scheduler.json"
    words = [sys.executable, "-m", "distributed.cli.dask_scheduler"]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    options = ["--scheduler-file", str(file), "--port", "0", "--no-dashboard"]
    started = [subprocess.Popen([*words, *options], **quiet, cwd=folder)]
    try:
        deadline = time.monotonic() + 60
        while not file.exists() and time.monotonic() < deadline:
            time.sleep(0.1)
        words = [sys.executable, "-m", "distributed.cli.dask_worker"]
        options = ["--scheduler-file", str(file), "--nthreads", "1", "--no-nanny"]
        options += ["--no-dashboard", "--local-directory", str(folder)]
        for _ in range(2):
            started.append(subprocess.Popen([*words, *options], **quiet, cwd=folder))
        yield json.loads(file.read_text())["address"], started[1:]
    finally:
        for process in started:
            process.kill()
            process.wait()


def test_a_worker_killed_in_mid_study_loses_and_doubles_nothing(studies, tmp_path):
    study = studies.Draws(60, wait_s=0.05)
    with programs(tmp_path) as (address, workers):
        with Results(tmp_path / "rows") as results:
            seen = []
            for row in results.run(study, workers=Cluster(address)):
                seen.append(row.key)
                if len(seen) == 10:
                    workers[0].send_signal(signal.SIGKILL)
            rows = results.rows(study)
        assert workers[0].wait() == -signal.SIGKILL
    assert sorted(seen) == sorted(case.key for case in study)
    assert len({row.metrics["pid_us"] for row in rows}) <= 2
    assert table(rows) == alone(study, tmp_path / "alone")


def test_nobody_at_the_address_is_said(studies, monkeypatch):
    monkeypatch.setattr("rrnn_opt.study.cluster.PATIENCE_S", 1.0)
    study = studies.Draws(1)
    with pytest.raises(WorkerError, match="no Dask cluster"):
        list(Cluster("tcp://127.0.0.1:9").rows(study, iter(study), 0))
