import os
import stat

import pytest

from rrnn_opt.report.files import write_bytes, write_text


def test_a_file_appears_whole_and_replaces_the_old_one(tmp_path):
    path = tmp_path / "a b" / "x.txt"
    path.parent.mkdir()
    assert write_text(path, "one") == path
    write_text(path, "zwei \N{GREEK SMALL LETTER ALPHA}")
    assert path.read_text("utf-8") == "zwei \N{GREEK SMALL LETTER ALPHA}"
    assert [p.name for p in path.parent.iterdir()] == ["x.txt"]


def test_the_permissions_are_those_of_an_ordinary_new_file(tmp_path):
    (tmp_path / "plain").write_bytes(b"")
    write_bytes(tmp_path / "ours", b"")
    modes = [stat.S_IMODE((tmp_path / n).stat().st_mode) for n in ("plain", "ours")]
    assert modes[0] == modes[1]


def test_a_failed_write_leaves_the_old_file_and_nothing_else(tmp_path, monkeypatch):
    path = tmp_path / "x"
    write_text(path, "old")

    def full(descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space left"):
        write_text(path, "new")
    assert path.read_text() == "old"
    assert [p.name for p in tmp_path.iterdir()] == ["x"]
