"""Only rows that are what was written count."""

import importlib

import pytest

from rrnn_opt.study.journal import FIELDS, intact, sealed

ROW = {
    "identity": "00ff",
    "study": "s",
    "key": "case",
    "seed": 0,
    "error": "",
    "time_s": 0.5,
    "metrics": {"error_m": 0.1},
}


def test_a_sealed_row_is_intact():
    assert intact(sealed(ROW))


@pytest.mark.parametrize("field", FIELDS)
def test_no_field_can_be_altered(field):
    assert not intact({**sealed(ROW), field: "ee"})


def test_no_field_can_be_added_or_left_out():
    assert not intact({**sealed(ROW), "more": 1})
    assert not intact({k: v for k, v in sealed(ROW).items() if k != "time_s"})


def test_a_part_whose_texts_are_none_is_no_part(tmp_path):
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    parts = importlib.import_module("rrnn_opt.study.parts")
    path = parts.write_part(tmp_path / "part-1.parquet", [sealed(ROW)])
    assert list(parts.read_part(path)) == [sealed(ROW)]
    whole = path.read_bytes()
    path.write_bytes(whole.replace(b"case", b"c\xff\xffe"))
    with pytest.raises(OSError, match=r"part-1\.parquet"):
        list(parts.read_part(path))
