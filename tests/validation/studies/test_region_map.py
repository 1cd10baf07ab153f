"""Tiles that are kept, and whose they are."""

from __future__ import annotations

import numpy as np

from rrnn_opt.study import Lines
from rrnn_opt.validation.studies.region_map import finished
from rrnn_opt.verification.region import RegionCell

ENDS = np.array([0.0, 0.1, 0.3])
WORK = [
    (np.array([a]), np.array([b]), ((a, a), (b, b)))
    for a, b in zip(ENDS[:-1].tolist(), ENDS[1:].tolist(), strict=True)
]
ASKED = {"robot": "planar3", "law": {"epsilon": 0.1}, "region": {"centre": (0.1,)}}


class Certifier:
    """Counts its tiles; sigma tells which robot a cell is of."""

    def __init__(self, sigma):
        self.sigma, self.seen = sigma, []

    def __call__(self, item):
        self.seen.append(item[2])
        return RegionCell(*item[2], 1.0, self.sigma, 0.1, 1.0, 0.1, 7)


def test_a_run_goes_on_with_the_tiles_that_are_missing(tmp_path):
    path = tmp_path / "tiles.jsonl"
    first, second = Certifier(1.0), Certifier(1.0)
    half = finished(Lines(path), ASKED, WORK[1:], first)
    whole = finished(Lines(path), ASKED, WORK, second)
    assert second.seen == [WORK[0][2]]
    assert whole[1:] == half
    assert [cell.lower for cell in whole] == [w[2][0] for w in WORK]


def test_a_damaged_line_is_measured_again_in_its_place(tmp_path):
    path = tmp_path / "tiles.jsonl"
    whole = finished(Lines(path), ASKED, WORK, Certifier(1.0))
    lines = path.read_text("utf-8").splitlines()
    path.write_text("\n".join(["{torn", lines[1]]) + "\n", "utf-8")
    assert finished(Lines(path), ASKED, WORK, Certifier(1.0)) == whole


def test_tiles_of_another_robot_are_not_taken(tmp_path):
    path = tmp_path / "tiles.jsonl"
    finished(Lines(path), ASKED, WORK, Certifier(9.0))
    for other in ({"robot": "pa10"}, {"law": {"epsilon": 0.2}}):
        found = finished(Lines(path), ASKED | other, WORK, Certifier(1.0))
        assert {cell.sigma for cell in found} == {1.0}
