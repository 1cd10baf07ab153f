"""A small part of the generated bad input, with the same seeds at each run."""

from __future__ import annotations

import pytest

from benchmarks.fuzz.entries import ENTRIES
from benchmarks.fuzz.judging import BAD, judged

CHEAP = ("scene", "sphere file", "point cloud", "package folder", "document file")
CHEAP += ("declarations in Python", "methods and compiled code")
"""Entries that take milliseconds an input."""


@pytest.mark.parametrize("name", CHEAP)
def test_bad_input_gets_a_sentence(name, tmp_path):
    entry = next(entry for entry in ENTRIES if entry.name == name)
    for number in range(20):
        ending = judged(entry, number, tmp_path)
        assert ending.kind not in BAD, f"{number}: {ending.text}"
