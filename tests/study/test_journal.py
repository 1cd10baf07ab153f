"""Only rows that are what was written count."""

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
