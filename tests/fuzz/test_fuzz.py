"""A small part of the generated bad input, with the same seeds at each run."""

from __future__ import annotations

import pytest

from benchmarks.fuzz.entries import ENTRIES
from benchmarks.fuzz.judging import BAD, judged

DEAR = (
    "command line",
    "HTML page",
    "URDF with meshes",
    "motion and planning in Python",
)
"""Entries that take tenths of a second each."""


def endings(entry, numbers, room):
    found = [(number, judged(entry, number, room)) for number in numbers]
    return [
        f"--show '{entry.name}' {number}: {end.kind}\n{end.text}"
        for number, end in found
        if end.kind in BAD
    ]


@pytest.mark.parametrize("entry", ENTRIES, ids=lambda entry: entry.name)
def test_bad_input_gets_a_sentence(entry, tmp_path):
    count = 2 if entry.name in DEAR else 3 * entry.share
    assert not endings(entry, range(100_000, 100_000 + count), tmp_path)


@pytest.mark.slow
@pytest.mark.parametrize("entry", ENTRIES, ids=lambda entry: entry.name)
def test_more_bad_input_gets_a_sentence(entry, tmp_path):
    count = 8 if entry.name in DEAR else 22 * entry.share
    assert not endings(entry, range(200_000, 200_000 + count), tmp_path)
