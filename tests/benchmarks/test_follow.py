"""Delivered motions followed by pinocchio and coal, which know nothing of ours."""

import itertools
from pathlib import Path

import pytest

from benchmarks.follow import follow
from rrnn_opt.check import check_plan
from rrnn_opt.planning import Problem, plan
from rrnn_opt.scene.library import SCENARIOS, scenario

MBM = sorted((Path(__file__).parents[1] / "data" / "mbm").glob("*.json"))


def keeps_clear(document):
    walked = follow(document)
    proved = document["certificate"]["clearance_lower_bound"]
    assert document["status"] == "solved", document["message"]
    assert walked.least > 0.0
    assert walked.least >= proved - 1e-9
    assert walked.outside <= 1e-12
    return walked


def test_a_window_plan_keeps_clear():
    problem = Problem.from_dict(scenario("window").problem(7))
    assert keeps_clear(plan(problem, seed=7).to_dict()).queries > 50


def test_following_sees_a_collision():
    document = plan(Problem.from_dict(scenario("window").problem(7)), seed=7).to_dict()
    pin = {
        "name": "pin",
        "type": "sphere",
        "radius": 0.02,
        "position": [0.7, 0.05, 0.45],
    }
    document["problem"]["obstacles"].append(pin)
    assert follow(document).least < 0.0


@pytest.mark.slow
@pytest.mark.parametrize("path", MBM, ids=lambda p: p.stem)
def test_a_panda_plan_keeps_clear(path):
    keeps_clear(plan(Problem.load(path), seed=3).to_dict())


@pytest.mark.slow
def test_hundreds_of_plans():
    """Each proved again from its document; every twentieth followed by coal."""
    starts = itertools.product(range(2), SCENARIOS, range(0, 50, 2))
    for count, (seed, name, start) in enumerate(starts):
        result = plan(Problem.from_dict(scenario(name).problem(start)), seed=seed)
        document = result.to_dict()
        assert check_plan(document).holds, (name, start, seed, result.message)
        if count % 20 == 0:
            keeps_clear(document)
    assert count == 249
