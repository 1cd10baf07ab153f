"""One MotionBenchMaker problem of each family, planned, timed and proved."""

from pathlib import Path

import pytest

from rrnn_opt.planning import Problem, plan

FAMILIES = sorted((Path(__file__).parents[1] / "data" / "mbm").glob("*.json"))


def test_every_family_is_here():
    assert len(FAMILIES) == 5


@pytest.mark.parametrize("path", FAMILIES, ids=lambda p: p.stem)
def test_family(path):
    problem = Problem.load(path)
    result = plan(problem, seed=0)
    assert result.status == "solved", result.message
    assert result.trajectory["q"][-1] == problem.goals[0].joints.tolist()
