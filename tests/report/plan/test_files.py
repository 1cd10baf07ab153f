import csv
import json
import sys

import numpy as np
import pytest

from rrnn_opt.report import write_plan


def test_four_files_that_say_the_same(window, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "viser", None)
    paths = write_plan(window, tmp_path / "new" / "folder")
    names = ["plan.json", "trajectory.csv", "plan.png", "plan.html"]
    assert [p.name for p in paths] == names
    assert json.loads(paths[0].read_text()) == window
    with paths[1].open(newline="") as file:
        header, *rows = list(csv.reader(file))
    assert header[:2] == ["t", "q1"]
    assert header[-1] == "qdd7"
    motion = window["trajectory"]
    blocks = [motion[key] for key in ("q", "qd", "qdd")]
    wanted = np.column_stack([motion["t"], *blocks])
    np.testing.assert_array_equal(np.array(rows, float), wanted)


@pytest.mark.slow
def test_without_a_trajectory_there_is_no_table(window, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "viser", None)
    paths = write_plan({**window, "trajectory": None}, tmp_path)
    assert [p.name for p in paths] == ["plan.json", "plan.png", "plan.html"]


def test_an_earlier_plan_goes_before_anything_is_written(window, tmp_path, monkeypatch):
    """Also where writing ends halfway: no table may stand beside another answer."""
    names = ["trajectory.csv", "plan.png", "plan.html"]
    for name in names:
        (tmp_path / name).write_text("of an earlier plan")
    seen = []

    def full(path, text):
        seen.append(sorted(file.name for file in tmp_path.iterdir()))
        raise OSError("No space left on device")

    monkeypatch.setattr("rrnn_opt.report.plan.files.write_text", full)
    with pytest.raises(OSError, match="No space left"):
        write_plan({**window, "trajectory": None}, tmp_path)
    assert seen == [[]]
