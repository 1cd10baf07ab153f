import os
import sys
import time

import pytest

from rrnn_opt.emit import compiler as module
from rrnn_opt.emit.compiler import FLAGS, cpu_name, find_compiler, run
from rrnn_opt.errors import CompilerError


def script(path, body):
    path.write_text(f"#!/bin/sh\n{body}\n")
    path.chmod(0o755)
    return path


@pytest.fixture
def nothing_installed(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setattr(module.importlib.util, "find_spec", lambda name: None)
    return tmp_path


def test_without_any_compiler_the_error_says_what_to_install(nothing_installed):
    with pytest.raises(CompilerError) as caught:
        find_compiler()
    assert "apt install gcc" in str(caught.value)
    assert "pip install rrnn_opt[compiler]" in str(caught.value)
    assert caught.value.command is None


def test_gcc_is_asked_before_clang_and_cc(nothing_installed):
    for name in ("cc", "clang", "gcc"):
        script(nothing_installed / name, f"echo {name} 1.0")
        assert find_compiler().version == f"{name} 1.0"
        os.environ["PATH"] += ":"  # a changed PATH is looked at again


def test_a_compiler_that_does_not_answer_is_passed_over(nothing_installed):
    script(nothing_installed / "gcc", "exit 3")
    script(nothing_installed / "cc", "echo honest cc")
    found = find_compiler()
    assert found.version == "honest cc"
    assert found.kind == "cc"


def test_cc_is_obeyed_with_its_arguments(nothing_installed, monkeypatch):
    tool = script(nothing_installed / "mycc", 'echo "mycc $1"')
    monkeypatch.setenv("CC", f"{tool} -m64")
    found = find_compiler()
    assert found.command == (str(tool), "-m64")
    assert found.version == "mycc -m64"


def test_a_wrong_cc_is_an_error_and_not_overruled(monkeypatch):
    monkeypatch.setenv("CC", "/nowhere/cc")
    with pytest.raises(CompilerError, match="unset CC"):
        find_compiler()


def test_zig_is_taken_when_nothing_else_is_there(nothing_installed, monkeypatch):
    pytest.importorskip("ziglang", reason="ziglang is not installed")
    monkeypatch.undo()
    monkeypatch.delenv("CC", raising=False)
    monkeypatch.setenv("PATH", str(nothing_installed))
    found = find_compiler()
    assert found.kind == "zig"
    assert found.command[1] == "cc"
    assert "-fno-sanitize=undefined" in found.flags


def test_flags_keep_arithmetic_defined():
    assert "-ffp-contract=off" in FLAGS
    assert not any("fast" in flag or "unsafe" in flag for flag in FLAGS)
    assert "-fvisibility=hidden" in FLAGS


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="needs Linux")
def test_objects_bind_their_own_names_first():
    assert "-Wl,-Bsymbolic" in find_compiler().flags


def test_the_cpu_is_named():
    assert len(cpu_name()) > 10


def test_a_hanging_command_is_killed_with_its_children(tmp_path):
    mark = tmp_path / "child"
    tool = script(tmp_path / "slow", f"sleep 60 & echo $! > {mark}; wait")
    start = time.monotonic()
    with pytest.raises(CompilerError, match=r"did not end within 0\.3 s"):
        run([str(tool)], timeout=0.3)
    assert time.monotonic() - start < 30  # not the minute of its child
    child = int(mark.read_text())
    for _ in range(50):
        if not alive(child):
            break
        time.sleep(0.05)
    assert not alive(child)


def alive(pid):
    try:
        with open(f"/proc/{pid}/stat") as file:
            return file.read().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def test_what_cannot_start_is_a_compiler_error(tmp_path):
    with pytest.raises(CompilerError, match="cannot start"):
        run([str(tmp_path / "missing")])
