"""Compilers that fail, hang, babble or cheat: an error of ours, and nothing kept."""

import os
import sys
import time

import pytest

from rrnn_opt.emit import build, find_compiler, load
from rrnn_opt.emit import compiler as module
from rrnn_opt.errors import CompilerError

SOURCE = '__attribute__((visibility("default"))) int the_answer(void) { return 42; }'
LAST = 'for last; do :; done; while [ "$1" != -o ]; do shift; done; out=$2'


@pytest.fixture
def cache(tmp_path, monkeypatch):
    folder = tmp_path / "cache"
    monkeypatch.setenv("RRNN_CACHE_DIR", str(folder))
    return folder


def tool(path, body):
    """A compiler that knows its version and then does ``body``."""
    lines = ["#!/bin/sh", '[ "$1" = --version ] && echo odd 1.0 && exit 0', body]
    path.parent.mkdir(exist_ok=True)
    path.write_text("\n".join(lines) + "\n")
    path.chmod(0o755)
    return path


BAD = {
    "fails": ("exit 3", "exit status 3"),
    "fails aloud": ("head -c 4000 /dev/urandom; exit 1", "exit status 1"),
    "crashes": ("kill -SEGV $$", "failed"),
    "makes nothing": ("exit 0", "no shared object"),
    "makes an empty file": (f'{LAST}; : > "$out"', "no shared object"),
    "makes text": (f'{LAST}; echo int > "$out"', "no shared object"),
    "makes half an object": (
        f'{LAST}; head -c 600 "{sys.executable}" > "$out"',
        "cannot load",
    ),
    "fills its folder with noise": (
        f'{LAST}; mkdir "$out"; exit 0',
        "nowhere to write|no shared object",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_a_bad_compiler_is_one_error_and_leaves_nothing(
    tmp_path, cache, monkeypatch, name
):
    body, said = BAD[name]
    monkeypatch.setenv("CC", str(tool(tmp_path / "cc", body)))
    for _ in range(2):
        with pytest.raises(CompilerError, match=said) as caught:
            load(build(SOURCE, name="answer"))
        assert len(str(caught.value)) < 600
        assert list(cache.glob("*.so")) == []
    monkeypatch.delenv("CC")
    assert load(build(SOURCE, name="answer")).the_answer() == 42


def test_a_compiler_that_compiles_something_else(tmp_path, cache, monkeypatch):
    real = " ".join(find_compiler().command)
    body = f'{LAST}; echo "int other;" > o.c; {real} -shared -fPIC o.c -o "$out"'
    monkeypatch.setenv("CC", str(tool(tmp_path / "cc", body)))
    monkeypatch.chdir(tmp_path)
    library = load(build(SOURCE, name="answer"))
    with pytest.raises(CompilerError, match="lacks 'the_answer'"):
        library.the_answer()


def test_a_compiler_whose_version_never_comes(tmp_path, cache, monkeypatch):
    path = tmp_path / "cc"
    path.write_text("#!/bin/sh\nsleep 60\n")
    path.chmod(0o755)
    run = module.run
    monkeypatch.setattr(module, "run", lambda words, **_: run(words, timeout=0.2))
    monkeypatch.setenv("CC", str(path))
    begin = time.monotonic()
    with pytest.raises(CompilerError, match="cannot be run"):
        build(SOURCE, name="answer")
    assert time.monotonic() - begin < 30  # not its minute


def test_a_path_with_spaces_may_be_quoted_or_not(tmp_path, cache, monkeypatch):
    real = " ".join(find_compiler().command)
    path = tool(tmp_path / "my tools" / "cc", f'exec {real} "$@"')
    for word in (str(path), f"'{path}'", f"'{path}' -DA='b c' -g0"):
        monkeypatch.setenv("CC", word)
        assert find_compiler().command[0] == str(path)
        assert load(build(SOURCE, name="answer")).the_answer() == 42
    assert find_compiler().command[1:] == ("-DA=b c", "-g0")


@pytest.mark.parametrize("word", ["gcc '", '"', "$(reboot)", "gcc; rm -rf x", "\\"])
def test_what_is_no_command_is_never_run_by_a_shell(cache, monkeypatch, word):
    monkeypatch.setenv("CC", word)
    with pytest.raises(CompilerError, match="cannot be run"):
        build(SOURCE, name="answer")


@pytest.mark.slow
def test_the_wheel_with_a_compiler_will_do(tmp_path, cache, monkeypatch):
    pytest.importorskip("ziglang", reason="ziglang is not installed")
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setenv("ZIG_GLOBAL_CACHE_DIR", os.path.expanduser("~/.cache/zig"))
    assert load(build(SOURCE, name="answer")).the_answer() == 42
