"""Generated controllers under any requests: finite, within limits, or told so."""

import pytest

from benchmarks.control_steps.cases import NETWORKS, ROBOTS, SCHEMES, Case, cases
from benchmarks.control_steps.run import run
from benchmarks.control_steps.table import report


def judged(row, steps):
    assert sum(row["status"]) == steps
    assert row["broken"] == 0
    assert row["status"][0] > steps // 4  # most requests can be fulfilled
    for refused in (1, 3, 5):  # not finite, empty limits, out of range
        assert row["status"][refused] > 0


def test_the_cases_cover_what_they_are_made_of():
    found = cases()
    for part, wanted in (("scheme", SCHEMES), ("network", NETWORKS), ("robot", ROBOTS)):
        assert {getattr(case, part) for case in found} == set(wanted)
    assert {(case.real, case.fallback) for case in found} == {
        (real, fallback) for real in ("float", "double") for fallback in (True, False)
    }


@pytest.mark.slow
def test_twenty_thousand_steps():
    case = Case("pa10", "repetitive_motion", "SimplifiedLviPdnn", "float", True)
    row = run(case, 20_000, 1)
    judged(row, 20_000)
    assert row["fell_back"] > 1000
    assert row["flagged"] == 0  # the exact solver answers where the network has not
    text = report({case: row}, "COMMAND")
    assert "**20000 steps, 0 broken promises.**" in text


@pytest.mark.slow
def test_without_the_exact_solver_unsettled_outputs_are_flagged():
    case = Case("pa10", "minimum_velocity", "LviPdnn", "float", False)
    row = run(case, 20_000, 2)
    judged(row, 20_000)
    assert row["flagged"] > row["flagged_outside"] > 0
    assert row["worst_promised"] <= 0.02
