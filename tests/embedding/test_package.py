"""Writing never harms what is already there."""

from __future__ import annotations

import json
import os

import pytest

from rrnn_opt.embedding.package import Package, with_manifest
from rrnn_opt.errors import RrnnError


def package(**files) -> Package:
    named = {name.replace("_", "/") + ".c": text for name, text in files.items()}
    return with_manifest("arm", named, {"prefix": "arm"})


def tree(folder):
    return {
        str(p.relative_to(folder)): p.read_text()
        for p in folder.rglob("*")
        if p.is_file()
    }


def test_a_new_folder_holds_exactly_the_files(tmp_path):
    made = package(src_a="one", b="two")
    folder = made.write(tmp_path / "deep" / "out")
    assert folder == tmp_path / "deep" / "out" / "arm"
    assert tree(folder) == dict(made.files)
    assert [p.name for p in folder.parent.iterdir()] == ["arm"]


def test_writing_again_replaces_ours_and_keeps_what_is_not(tmp_path):
    folder = package(src_a="one", b="two").write(tmp_path)
    (folder / "build").mkdir()
    (folder / "build" / "mine.o").write_text("mine")
    (folder / "notes.txt").write_text("mine")
    made = package(src_a="ONE", c="three")
    made.write(tmp_path)
    mine = {"build/mine.o": "mine", "notes.txt": "mine"}
    assert tree(folder) == dict(made.files) | mine
    made.write(tmp_path)
    assert tree(folder) == dict(made.files) | mine


@pytest.mark.parametrize(
    "manifest", [None, "not json", "{}", '{"kind": "other", "files": {}}', "[]"]
)
def test_a_folder_of_someone_else_is_refused(tmp_path, manifest):
    folder = tmp_path / "arm"
    folder.mkdir()
    (folder / "thesis.tex").write_text("years of work")
    if manifest is not None:
        (folder / "MANIFEST.json").write_text(manifest)
    before = tree(tmp_path)
    with pytest.raises(RrnnError, match="not a package of ours"):
        package(a="one").write(tmp_path)
    assert tree(tmp_path) == before


def test_an_empty_folder_is_fine_and_a_file_or_link_is_not(tmp_path):
    (tmp_path / "arm").mkdir()
    assert package(a="one").write(tmp_path) == tmp_path / "arm"
    (tmp_path / "x").mkdir()
    (tmp_path / "x" / "arm").write_text("a file")
    with pytest.raises(RrnnError, match="not a folder"):
        package(a="one").write(tmp_path / "x")
    (tmp_path / "y").mkdir()
    (tmp_path / "y" / "arm").symlink_to(tmp_path / "arm")
    with pytest.raises(RrnnError, match="not a folder"):
        package(a="one").write(tmp_path / "y")


def test_a_manifest_cannot_name_files_outside(tmp_path):
    folder = package(a="one").write(tmp_path)
    (tmp_path / "precious").write_text("keep")
    manifest = json.loads((folder / "MANIFEST.json").read_text())
    manifest["files"]["../precious"] = "0"
    manifest["files"][str(tmp_path / "precious")] = "0"
    (folder / "MANIFEST.json").write_text(json.dumps(manifest))
    package(a="two").write(tmp_path)
    assert (tmp_path / "precious").read_text() == "keep"


def test_a_failure_on_the_way_leaves_nothing(tmp_path, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("pathlib.Path.write_bytes", full)
    with pytest.raises(RrnnError, match="No space left"):
        package(a="one").write(tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_cannot_be_made_is_said(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(RrnnError, match="cannot write"):
        package(a="one").write(os.fspath(tmp_path / "file"))
