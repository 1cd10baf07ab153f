"""Documents that cannot be read: one sentence each, and where."""

import json
import os

import pytest

from rrnn_opt.errors import DocumentError, ProblemError
from rrnn_opt.files import from_python, read_bytes, read_json, read_text
from rrnn_opt.planning.problem.problem import Problem

START = '{"robot": "planar3", "goal": {"position": [1, 1, 0]}, "start": '


@pytest.mark.parametrize(
    ("raw", "words"),
    [
        (b"", "line 1, column 1: not JSON"),
        (b'{"a": 1,\n "b": }', "line 2, column 7: not JSON"),
        (b'{"a": 1} 2', "line 1, column 10: not JSON"),
        (b'{"a": 1, "b": 2, "a": 3}', "the key 'a' stands twice"),
        (b'{"b": {"a\\n": 1, "a\\n": 3}}', "stands twice"),
        (b'{"a": "\xff"}', "not UTF-8 text (byte 7)"),
        (b"[" * 200_000, "nested too deeply"),
        (b'{"a":' * 200_000, "nested too deeply"),
        (b"1" * 6000, "too many digits"),
    ],
    ids=["empty", "broken", "rest", "twice", "twice-below", "utf-8", "lists", "objects",
         "digits"],
)  # fmt: skip
def test_unreadable(tmp_path, raw, words):
    path = tmp_path / "p.json"
    path.write_bytes(raw)
    with pytest.raises(DocumentError) as caught:
        Problem.load(path)
    assert words in str(caught.value)
    assert caught.value.path == str(path)
    assert "\n" not in str(caught.value)


def test_a_file_of_gigabytes_is_not_read(tmp_path):
    path = tmp_path / "p.json"
    path.write_bytes(b" " * (2**20 - 2) + b"{}")
    assert read_text(path, most=2**20).endswith("{}")
    path.write_bytes(b" " * 2**20 + b"{}")
    with pytest.raises(DocumentError, match="larger than 1 MiB"):
        read_text(path, most=2**20)
    with path.open("wb") as file:
        file.truncate(200 * 2**30)
    with pytest.raises(DocumentError, match="larger than 64 MiB"):
        read_json(path)


def test_devices_and_pipes_are_no_files(tmp_path):
    os.mkfifo(tmp_path / "pipe")
    for path in ("/dev/zero", tmp_path / "pipe"):
        with pytest.raises(DocumentError, match="it is no file"):
            read_bytes(path)


@pytest.mark.parametrize(
    ("source", "words"),
    [
        ("x = ", "SyntaxError"),
        ("raise RuntimeError('mine')", r"fails in line 1 \(RuntimeError: mine\)"),
        ("import sys\nsys.exit(0)", r"fails in line 2 \(SystemExit: 0\)"),
        ("def made(): raise KeyError('k')", "fails in line 1"),
        ("def made(): return None", "not iterable"),
        ("def made(): return made()", "RecursionError"),
        ("made = 3", r"defines no function made\(\)"),
        ("def made(n): return []", "TypeError"),
    ],
)
def test_a_users_program_that_fails_is_named_with_its_line(tmp_path, source, words):
    path = tmp_path / "own.py"
    path.write_text(source)
    with pytest.raises(DocumentError, match=words):
        from_python(path, "made")


def test_no_file_a_folder_and_a_name_that_no_file_can_have(tmp_path):
    with pytest.raises(DocumentError, match="cannot be read: No such file"):
        Problem.load(tmp_path / "none.json")
    with pytest.raises(DocumentError, match="cannot be read: Is a directory"):
        Problem.load(tmp_path)
    with pytest.raises(DocumentError, match="cannot be read: embedded null byte"):
        Problem.load("a\0b")


@pytest.mark.parametrize("word", ["NaN", "Infinity", "-Infinity", "1e999"])
def test_numbers_that_are_not_finite_are_named_by_their_field(tmp_path, word):
    path = tmp_path / "p.json"
    path.write_text(f"{START}[0, {word}, 0]}}")
    with pytest.raises(ProblemError, match=r"start\[1\]: expected a finite number"):
        Problem.load(path)


def test_a_byte_order_mark_is_skipped(tmp_path):
    path = tmp_path / "p.json"
    path.write_text(f"{START}[0, 0, 0]}}", encoding="utf-8-sig")
    assert Problem.load(str(path)).robot_ref == "planar3"
    assert read_json(path) == json.loads(path.read_text(encoding="utf-8-sig"))
