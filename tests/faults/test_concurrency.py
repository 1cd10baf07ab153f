"""Ten processes, threads and forks over one cache: one compilation, one answer."""

import json
import multiprocessing
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from rrnn_opt.emit import build, cache, find_compiler, load
from rrnn_opt.planning import Problem, plan
from tests.child import ended, forked
from tests.faults.conftest import HERE, PROBLEM
from tests.faults.test_compilers import SOURCE, tool

BUILD = (
    "from rrnn_opt.emit import build, load;"
    f"built = build({SOURCE!r}, name='answer');"
    "print(load(built).the_answer(), built.cached)"
)


def flipped(path):
    """Overwrite an entry with one bit turned, under the same name."""
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    path.unlink()
    path.write_bytes(data)


def many(count, code, **more):
    environment = os.environ | {"PYTHONPATH": str(HERE)} | more
    start = [sys.executable, "-c", code]
    pipe = subprocess.PIPE
    return [
        subprocess.Popen(start, stdout=pipe, stderr=pipe, text=True, env=environment)
        for _ in range(count)
    ]


@pytest.mark.slow
@pytest.mark.parametrize("state", ["cold", "corrupted", "foreign"])
def test_ten_processes_compile_once(tmp_path, monkeypatch, state):
    folder = tmp_path / "cache"
    real = " ".join(find_compiler().command)
    log = tmp_path / "log"
    body = f'echo $$ >> "{log}"; sleep 0.5; exec {real} "$@"'
    names = {"CC": str(tool(tmp_path / "cc", body)), "RRNN_CACHE_DIR": str(folder)}
    if state != "cold":
        for key, value in names.items():
            monkeypatch.setenv(key, value)
        path = build(SOURCE, name="answer").path
        if state == "corrupted":
            flipped(path)
        else:  # another program's object, under our name and without our digest
            path.unlink()
            path.write_bytes(Path(sys.executable).read_bytes()[:100_000])
        log.unlink()
    workers = many(10, BUILD, **names)
    told = [worker.communicate(timeout=120) for worker in workers]
    assert [error for _, error in told if error] == []
    assert sorted(said.strip() for said, _ in told) == ["42 False"] + ["42 True"] * 9
    assert len(log.read_text().splitlines()) == 1
    assert [cache.valid(p) for p in folder.glob("*.so")] == [True]


ODD = {
    "a folder": lambda path: path.mkdir(),
    "a full folder": lambda path: (path / "x").mkdir(parents=True),
    "a pipe": os.mkfifo,
    "a device": lambda path: path.symlink_to("/dev/zero"),
    "a link to itself": lambda path: path.symlink_to(path),
    "a link to nothing": lambda path: path.symlink_to("nothing"),
    "nothing": lambda path: path.write_bytes(b""),
}


@pytest.mark.parametrize("kind", ODD)
@pytest.mark.parametrize("where", ["entry", "lock"])
def test_what_is_no_entry_is_neither_waited_for_nor_loaded(
    tmp_path, monkeypatch, kind, where
):
    cache.private_folder.cache_clear()
    monkeypatch.setenv("RRNN_CACHE_DIR", str(tmp_path))
    path = build(SOURCE, name="answer").path
    (lock,) = (tmp_path / "locks").iterdir()
    path.unlink()
    odd = path if where == "entry" else lock
    lock.unlink()
    ODD[kind](odd)
    built = build(SOURCE, name="answer")
    assert not built.cached
    assert load(built).the_answer() == 42
    cache.private_folder.cache_clear()


def test_a_stopped_builder_is_not_waited_for(tmp_path, monkeypatch):
    monkeypatch.setenv("RRNN_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(cache, "PATIENCE", 0.1)
    build(SOURCE, name="answer").path.unlink()
    (lock,) = (tmp_path / "locks").iterdir()
    with cache.lock(tmp_path, lock.name):
        assert load(build(SOURCE, name="answer")).the_answer() == 42


@pytest.mark.slow
def test_every_bit_counts(tmp_path, monkeypatch):
    """A sample of all bits of an entry, its digest among them: none is loaded."""
    monkeypatch.setenv("RRNN_CACHE_DIR", str(tmp_path))
    path = build(SOURCE, name="answer").path
    data = path.read_bytes()
    rng = np.random.default_rng(0)
    for bit in rng.choice(8 * len(data), 300, replace=False):
        damaged = bytearray(data)
        damaged[bit // 8] ^= 1 << (bit % 8)
        path.unlink()
        path.write_bytes(damaged)
        assert not cache.valid(path)
    for length in rng.integers(0, len(data), 100):
        path.unlink()
        path.write_bytes(data[:length])
        assert not cache.valid(path)
    assert build(SOURCE, name="answer").cached is False
    assert load(path).the_answer() == 42


def answer(seed=0):
    """What a plan says, times set aside."""
    document = plan(Problem.from_dict(PROBLEM), seed=seed).to_dict()
    return json.dumps([document["path"], document["trajectory"], document["status"]])


def test_threads_plan_side_by_side():
    wanted = [answer(seed) for seed in range(4)]
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(answer, list(range(4)) * 2)) == wanted * 2


def _report(pipe):
    pipe.send(answer())
    pipe.close()


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_a_forked_process_plans_the_same():
    wanted = answer()
    here, there = multiprocessing.Pipe()
    child = forked(lambda: _report(there))
    assert here.poll(60)
    assert here.recv() == wanted
    assert ended(child) == 0


@pytest.mark.slow
def test_the_number_of_blas_threads_changes_nothing(warm_cache):
    code = "from tests.faults.test_concurrency import answer; print(answer())"
    names = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
    told = set()
    for count in "14":
        more = dict.fromkeys(names, count) | {"RRNN_CACHE_DIR": str(warm_cache)}
        said, error = many(1, code, **more)[0].communicate(timeout=120)
        assert said, error
        told.add(said)
    assert len(told) == 1
