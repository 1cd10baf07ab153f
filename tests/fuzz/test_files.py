"""Tricks with files, each of which got through once."""

from __future__ import annotations

import json
import os

import pytest

from benchmarks.fuzz import bases
from rrnn_opt.embedding import Package
from rrnn_opt.embedding.package import with_manifest
from rrnn_opt.errors import DocumentError, RobotError, RrnnError
from rrnn_opt.report import file_name
from rrnn_opt.report.plan.drawing import drawing_of
from rrnn_opt.robot import Robot
from rrnn_opt.study import Store


def robot(tmp_path, text):
    path = tmp_path / "r.urdf"
    path.write_text(text, encoding="utf-8")
    return Robot.from_urdf(path)


def test_a_urdf_of_thousands_of_links_or_levels_is_refused(tmp_path):
    links = "".join(f"<link name='l{k}'/>" for k in range(2_000))
    with pytest.raises(RobotError, match="has 2000 links; at most 1000"):
        robot(tmp_path, f"<robot name='r'>{links}</robot>")
    nested = "<a>" * 200_000 + "</a>" * 200_000
    with pytest.raises(RobotError, match="nested more than 50 deep"):
        robot(tmp_path, f"<robot name='r'>{nested}<link name='x'/></robot>")


def test_a_pipe_is_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "r.urdf")
    with pytest.raises(RobotError, match="it is no file"):
        Robot.from_urdf(tmp_path / "r.urdf")


def test_a_journal_that_is_a_link_is_neither_cut_nor_written(tmp_path):
    other = tmp_path / "other.txt"
    other.write_text("no end of line")
    rows = tmp_path / "rows"
    rows.mkdir()
    (rows / "journal.jsonl").symlink_to(other)
    with pytest.raises(OSError, match="link"):
        Store(rows)
    assert other.read_text() == "no end of line"


@pytest.mark.parametrize("name", ["../x", "/tmp/x", "a\0b", "", "..", "a/../../x"])
def test_no_file_of_a_package_leads_out_of_its_folder(name):
    with pytest.raises(RrnnError, match="no name of a file"):
        Package("arm", {name: "x"})
    with pytest.raises(RrnnError, match="prefix"):
        Package(name, {"a.c": "x"})


def test_a_package_is_not_written_through_a_link(tmp_path):
    package = with_manifest("arm", {"inner/a.c": "1"}, {})
    package.write(tmp_path / "out")
    inner, other = tmp_path / "out" / "arm" / "inner", tmp_path / "other"
    (inner / "a.c").unlink()
    inner.rmdir()
    other.mkdir()
    (other / "a.c").write_text("keep")
    inner.symlink_to(other)
    with pytest.raises(RrnnError, match="is a link to another folder"):
        package.write(tmp_path / "out")
    assert (other / "a.c").read_text() == "keep"


def test_a_name_becomes_a_file_name_and_no_path():
    assert file_name("C20a_repaired") == "C20a_repaired"
    for name in ("../../x", "/etc/passwd", "a\0b", "x" * 5000, "", "..", "\ud800"):
        made = file_name(name)
        assert "/" not in made
        assert 0 < len(made.encode()) < 120
        assert made.strip(".")


def test_a_plan_of_another_form_is_not_drawn():
    document = json.loads(bases.plan_text())
    for change in (None, [], {"velocity": [0.0] * 3}, {"velocity": ["x"] * 3}):
        document["robot"]["limits"] = change
        with pytest.raises(DocumentError, match=r"robot\.limits"):
            drawing_of(document)
