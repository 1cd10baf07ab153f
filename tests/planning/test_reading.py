"""Documents that cannot be read: one sentence each, and where."""

import json

import pytest

from rrnn_opt.errors import DocumentError, ProblemError
from rrnn_opt.planning import reading
from rrnn_opt.planning.problem import Problem
from rrnn_opt.planning.reading import read_json

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


def test_a_file_of_gigabytes_is_not_read(tmp_path, monkeypatch):
    monkeypatch.setattr(reading, "LARGEST_DOCUMENT", 2**20)
    path = tmp_path / "p.json"
    path.write_bytes(b" " * (2**20 - 2) + b"{}")
    assert read_json(path) == {}
    path.write_bytes(b" " * 2**20 + b"{}")
    with pytest.raises(DocumentError, match="larger than 1 MiB"):
        read_json(path)


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
