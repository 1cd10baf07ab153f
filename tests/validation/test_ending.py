"""Studies run as programs end with a sentence and a status."""

from __future__ import annotations

import errno

import pytest

from rrnn_opt.errors import RrnnError
from rrnn_opt.validation.ending import ended


@pytest.mark.parametrize(
    ("error", "code", "said"),
    [
        (RrnnError("no such\npage"), 2, "no such page\n"),
        (OSError(errno.ENOSPC, "No space left", "x.md"), 2, "x.md: No space left\n"),
        (OSError("odd"), 2, "odd\n"),
        (KeyboardInterrupt(), 130, "interrupted\n"),
    ],
)
def test_what_stops_a_study_is_one_sentence(capsys, error, code, said):
    def main():
        raise error

    assert ended(main) == code
    assert capsys.readouterr().err == said


@pytest.mark.parametrize(("given", "code"), [(None, 0), (0, 0), (1, 1), ("page", 0)])
def test_the_status_of_the_study_is_kept(given, code):
    assert ended(lambda: given) == code


def test_a_fault_of_ours_is_not_hidden():
    with pytest.raises(ZeroDivisionError):
        ended(lambda: 1 // 0)
