"""The cache under concurrency, kills, corruption and folders that refuse."""

import ctypes
import os
import signal
import subprocess
import sys
import time

import pytest

from rrnn_opt.emit import build, cache, find_compiler, load
from rrnn_opt.errors import CompilerError

SOURCE = '__attribute__((visibility("default"))) int the_answer(void) { return 42; }'
BUILD = (
    "from rrnn_opt.emit import build, load;"
    f"built = build({SOURCE!r}, name='answer');"
    "print(load(built).the_answer(), built.cached)"
)


def python(code, **extra):
    return subprocess.Popen(
        [sys.executable, "-c", code],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, **extra},
    )


def counting_compiler(tmp_path, body):
    """A compiler that writes a line for every compilation, then does ``body``."""
    real = " ".join(find_compiler().command)
    tool = tmp_path / "counting-cc"
    lines = [
        "#!/bin/sh",
        f'[ "$1" = --version ] && exec {real} --version',
        f"echo $$ >> {tmp_path}/log",
        body.format(real=real),
    ]
    tool.write_text("\n".join(lines))
    tool.chmod(0o755)
    return str(tool), tmp_path / "log"


def entries(folder):
    return sorted(path.name for path in folder.glob("*.so"))


def leftovers(folder):
    return list(folder.glob(".new-*"))


def test_the_second_build_is_cached(cold_cache):
    first, second = (build(SOURCE, name="answer") for _ in range(2))
    assert (first.cached, second.cached) == (False, True)
    assert first.path == second.path
    assert first.path.parent == cold_cache
    assert load(second).the_answer() == 42
    assert leftovers(cold_cache) == []


def test_source_flags_compiler_and_cpu_make_the_key(cold_cache, monkeypatch):
    paths = {build(SOURCE, name="answer").path}
    paths.add(build(SOURCE + " ", name="answer").path)
    paths.add(build(SOURCE, name="answer", flags=("-O1",)).path)
    with monkeypatch.context() as patch:
        patch.setattr("rrnn_opt.emit.host.cpu_name", lambda: "another cpu")
        paths.add(build(SOURCE, name="answer").path)
    assert len(paths) == 4


def test_the_folder_follows_the_environment(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "xdg"))
    monkeypatch.delenv("RRNN_CACHE_DIR")
    assert cache.cache_folder() == tmp_path / "xdg" / "rrnn_opt"
    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.setenv("HOME", str(tmp_path))
    assert cache.cache_folder() == tmp_path / ".cache" / "rrnn_opt"


def test_six_processes_compile_once(cold_cache, tmp_path):
    command, log = counting_compiler(tmp_path, 'sleep 0.3; exec {real} "$@"')
    workers = [python(BUILD, CC=command) for _ in range(6)]
    results = [worker.communicate(timeout=60) for worker in workers]
    assert [err for _, err in results if err] == []
    assert sorted(out.strip() for out, _ in results) == ["42 False"] + ["42 True"] * 5
    assert len(log.read_text().splitlines()) == 1
    assert len(entries(cold_cache)) == 1


def test_without_locks_processes_do_not_disturb_one_another(cold_cache, tmp_path):
    cold_cache.mkdir()
    (cold_cache / "locks").write_text("a file where a folder is wanted")
    workers = [python(BUILD) for _ in range(3)]
    results = [worker.communicate(timeout=60) for worker in workers]
    assert [out.split()[0] for out, _ in results] == ["42"] * 3
    assert len(entries(cold_cache)) == 1
    assert leftovers(cold_cache) == []


def test_a_kill_during_compilation_leaves_no_entry(cold_cache, tmp_path):
    body = (
        'for last; do :; done; while [ "$1" != -o ]; do shift; done;'
        ' printf half > "$2"; sleep 60'
    )
    command, log = counting_compiler(tmp_path, body)
    worker = python(BUILD, CC=command)
    for _ in range(400):
        if log.exists() and log.read_text():
            break
        time.sleep(0.05)
    compiler = int(log.read_text())
    worker.kill()
    worker.communicate()
    os.killpg(compiler, signal.SIGKILL)  # the orphan that our own test started
    assert entries(cold_cache) == []
    built = build(SOURCE, name="answer")  # the lock died with its holder
    assert load(built).the_answer() == 42


def test_a_kill_before_the_rename_leaves_no_entry(cold_cache):
    kill = "import os; os.replace = lambda *a: os.kill(os.getpid(), 9);"
    worker = python(kill + BUILD)
    worker.communicate(timeout=60)
    assert worker.returncode == -signal.SIGKILL
    assert entries(cold_cache) == []
    assert len(leftovers(cold_cache)) == 1
    assert build(SOURCE, name="answer").cached is False


def test_old_leftovers_are_swept_and_young_ones_are_not(cold_cache):
    cold_cache.mkdir()
    old, young = cold_cache / ".new-old.tmp", cold_cache / ".new-young.tmp"
    for path in (old, young):
        path.write_text("half")
    os.utime(old, (0, 0))
    build(SOURCE, name="answer")
    assert leftovers(cold_cache) == [young]


@pytest.mark.parametrize("damage", ["truncate", "flip", "empty", "foreign"])
def test_a_corrupted_entry_is_built_again(cold_cache, damage):
    path = build(SOURCE, name="answer").path
    data = path.read_bytes()
    damaged = {
        "truncate": data[: len(data) // 2],
        "flip": data[:4000] + bytes([data[4000] ^ 1]) + data[4001:],
        "empty": b"",
        "foreign": b"not a shared object",
    }[damage]
    path.unlink()  # a new file: no process has the damaged bytes mapped
    path.write_bytes(damaged)
    again = build(SOURCE, name="answer")
    assert again.cached is False
    assert cache.valid(again.path)
    assert load(again).the_answer() == 42


def test_a_cache_that_cannot_be_a_folder_is_no_obstacle(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("RRNN_CACHE_DIR", str(tmp_path / "file" / "cache"))
    first, second = (build(SOURCE, name="answer") for _ in range(2))
    assert load(first).the_answer() == 42
    assert first.path.parent == cache.private_folder()
    assert second.cached


def test_a_full_disk_is_no_obstacle(cold_cache, monkeypatch):
    real = cache.store

    def full(path, body):
        if path.parent == cold_cache:
            raise OSError(28, "No space left on device")
        real(path, body)

    monkeypatch.setattr(cache, "store", full)
    source = SOURCE.replace("42", "43")
    built = build(source, name="answer")
    assert built.path.parent == cache.private_folder()
    assert load(built).the_answer() == 43
    assert build(source, name="answer").cached


def test_a_write_that_fails_leaves_nothing(tmp_path, monkeypatch):
    def fail(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", fail)
    with pytest.raises(OSError, match="No space"):
        cache.store(tmp_path / "x.so", b"body")
    assert list(tmp_path.iterdir()) == []


def test_nowhere_to_write_is_one_clear_error(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("RRNN_CACHE_DIR", str(tmp_path / "file" / "cache"))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "missing"))
    with pytest.raises(CompilerError, match="TMPDIR"):
        build(SOURCE + "/* nowhere */", name="answer")


def test_a_private_folder_goes_with_its_process(tmp_path):
    (tmp_path / "file").write_text("")
    (tmp_path / "tmp").mkdir()
    folder, temporary = str(tmp_path / "file" / "cache"), str(tmp_path / "tmp")
    worker = python(BUILD, RRNN_CACHE_DIR=folder, TMPDIR=temporary)
    out, err = worker.communicate(timeout=60)
    assert (out.split()[0], err) == ("42", "")
    assert os.listdir(temporary) == []


def test_the_digest_behind_the_object_does_not_disturb_the_loader(cold_cache):
    path = build(SOURCE, name="answer").path
    assert path.read_bytes().rpartition(b"\nrrnn_opt sha256 ")[1]
    assert ctypes.CDLL(str(path)).the_answer() == 42


@pytest.mark.parametrize("chosen", ["", "~no_such_user_here/x"])
def test_a_user_without_a_home_compiles_all_the_same(monkeypatch, tmp_path, chosen):
    def homeless(self):
        raise RuntimeError("Could not determine home directory.")

    cache.private_folder.cache_clear()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    monkeypatch.setenv("RRNN_CACHE_DIR", chosen)
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setattr("pathlib.Path.expanduser", homeless)
    source = '__attribute__((visibility("default"))) int two(void) { return 2; }'
    assert load(build(source, name="two")).two() == 2
    assert not list(tmp_path.glob("~*"))
    cache.private_folder.cache_clear()
