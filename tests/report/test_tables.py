import pytest

from rrnn_opt.errors import RrnnError
from rrnn_opt.report.tables import check_line, table


def test_numbers_stand_on_the_right_and_text_on_the_left():
    text = table(("name", "value"), [("a", 1.5), ("long name", 22), ("c", None)])
    assert text.splitlines() == [
        "name       value",
        "─────────  ─────",
        "a            1.5",
        "long name     22",
        "c              -",
    ]


def test_a_cell_stays_on_its_line():
    assert "a b" in table(("x",), [("a\nb",)])


def test_a_row_of_the_wrong_length_is_refused():
    with pytest.raises(RrnnError, match="2 cells"):
        table(("a", "b"), [("only one",)])


def test_check_lines_say_number_and_tolerance():
    assert check_line("error", True, 1e-9, 1e-6) == "PASS  error  1e-09 <= 1e-06"
    assert check_line("error", False, 2.0, 1.0) == "FAIL  error  2 > 1"
    assert check_line("alone", True) == "PASS  alone"
