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


@pytest.mark.parametrize("scale", [3.0, 3.3])
def test_a_plan_past_a_mesh_keeps_clear(tmp_path, scale):
    pytest.importorskip("trimesh")
    corners = itertools.product((0.0, 0.1), repeat=3)
    lines = [f"v {x} {y} {z}" for x, y, z in corners]
    (tmp_path / "cube.obj").write_text("\n".join([*lines, "f 1 2 3", "f 6 7 8"]))
    rock = {
        "type": "mesh",
        "path": str(tmp_path / "cube.obj"),
        "scale": scale,
        "position": [1.3, 0.9, -0.1],
        "quat_xyzw": [0.0, 0.0, 0.6, 0.8],
    }
    problem = {
        "robot": "planar3",
        "start": [0.0, 0.0, 0.0],
        "goal": {"joints": [1.2, 0.2, -0.1]},
        "obstacles": [rock],
    }
    document = plan(Problem.from_dict(problem), seed=1).to_dict()
    keeps_clear(document)
    rock["scale"] = 2.0 * scale  # what the plan did not know of
    assert follow({**document, "problem": problem}).least < 0.0


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
