"""Killed, blocked or doubled while it writes over an older package."""

from __future__ import annotations

import json
import os
import signal
import sys
from pathlib import Path

import pytest

from benchmarks.faults.deadly import Counter
from rrnn_opt.embedding import placing
from rrnn_opt.embedding.package import with_manifest
from rrnn_opt.embedding.placing import MANIFEST, UNFINISHED
from rrnn_opt.errors import RrnnError
from tests.child import ended, forked

OLD = with_manifest("arm", {f"{n}": f"old {n}\n" for n in ("a.c", "a.h", "s/b.c")}, {})
NEW = with_manifest("arm", {f"{n}": f"new {n}\n" for n in ("a.c", "a.h", "s/c.h")}, {})
OTHER = with_manifest("arm", {"z.c": "other z\n", "a.c": "other a\n"}, {})


def tree(folder):
    found = (p for p in folder.rglob("*") if p.is_file())
    return {str(p.relative_to(folder)): p.read_text() for p in found}


def in_a_child(work, kill_at=0, folder=Path("/")):
    """A forked process that is killed before a change of a file."""

    def watched():
        sys.addaudithook(Counter(kill_at, folder))
        work()

    return forked(watched)


def truthful(folder, mine):
    """No file of two packages; a manifest only where the package is whole."""
    found = tree(folder)
    assert found.pop("mine.txt") == mine
    listed = found.pop(UNFINISHED, None)
    whole = MANIFEST in found
    words = {text.split()[0] for name, text in found.items() if name != MANIFEST}
    assert len(words) <= 1, found
    assert whole == (found in (dict(OLD.files), dict(NEW.files)))
    assert whole or listed is not None
    if any(name.endswith(".h") for name in found):  # then nothing but these lacks
        package = OLD if words == {"old"} else NEW
        assert {n for n in package.files if n.endswith(".c")} <= set(found)
    return whole


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
@pytest.mark.parametrize("then", [NEW, OTHER], ids=["the same again", "another"])
def test_killed_before_every_change_of_a_file(tmp_path, then):
    seen = []
    for k in range(1, 100):
        out = tmp_path / str(k)
        folder = OLD.write(out)
        (folder / "mine.txt").write_text("mine")
        code = ended(in_a_child(lambda out=out: NEW.write(out), k, out))
        seen.append(truthful(folder, "mine"))
        if code == 0:
            break
        assert code == -signal.SIGKILL
        then.write(out)
        assert tree(folder) == {**then.files, "mine.txt": "mine"}
    assert tree(folder) == {**NEW.files, "mine.txt": "mine"}
    assert k > 15
    assert seen.count(False) > 5


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_writers_side_by_side_leave_one_package(tmp_path):
    packages = [OLD, NEW, OTHER] * 3
    children = [in_a_child(lambda p=p: p.write(tmp_path)) for p in packages]
    assert [ended(child) for child in children] == [0] * 9
    assert tree(tmp_path / "arm") in [dict(p.files) for p in (OLD, NEW, OTHER)]
    assert [p.name for p in tmp_path.iterdir()] == ["arm"]


def test_a_writer_that_never_ends_is_not_waited_for(tmp_path, monkeypatch):
    fcntl = pytest.importorskip("fcntl", reason="needs file locks")
    monkeypatch.setattr(placing, "PATIENCE", 0.05)
    handle = os.open(tmp_path, os.O_RDONLY)
    fcntl.flock(handle, fcntl.LOCK_EX)
    with pytest.raises(RrnnError, match="another process writes"):
        NEW.write(tmp_path)
    assert list(tmp_path.iterdir()) == []
    os.close(handle)
    assert tree(NEW.write(tmp_path)) == dict(NEW.files)


@pytest.mark.parametrize("blocked", ["a.h", "s"])
def test_what_blocks_is_refused_before_anything_is_removed(tmp_path, blocked):
    folder = OTHER.write(tmp_path)
    if blocked == "s":
        (folder / blocked).write_text("a file")
    else:
        (folder / blocked).mkdir()
    before = tree(folder)
    with pytest.raises(RrnnError, match="belongs; remove it"):
        NEW.write(tmp_path)
    assert tree(folder) == before


def test_the_list_of_an_unfinished_writing_names_no_file_outside(tmp_path):
    folder = OLD.write(tmp_path)
    (tmp_path / "precious").write_text("keep")
    names = ["../precious", str(tmp_path / "precious"), 3, None]
    text = json.dumps({"kind": "rrnn_opt C package", "files": names})
    (folder / UNFINISHED).write_text(text)
    NEW.write(tmp_path)
    assert tree(folder) == dict(NEW.files)
    assert (tmp_path / "precious").read_text() == "keep"
