"""A posture near an obstacle is called infeasible with a proof, and only then."""

import itertools

import numpy as np
import pytest

from rrnn_opt.planning import Problem, plan
from rrnn_opt.planning.search.feasibility import blocked
from rrnn_opt.planning.search.request import pack
from rrnn_opt.planning.searches import open_search, runtime_for
from rrnn_opt.planning.settings.planners import PLANNERS

EDGE, RADIUS = 0.1, 0.05
END = np.array([2.390560596653324, 0.0, 0.0])
"""Centre of the last sphere of the stretched arm, of radius ``RADIUS``."""


@pytest.fixture(scope="module")
def cube(tmp_path_factory):
    path = tmp_path_factory.mktemp("mesh") / "cube.obj"
    corners = itertools.product((0.0, EDGE), repeat=3)
    lines = [f"v {x} {y} {z}" for x, y, z in corners]
    path.write_text("\n".join([*lines, "f 1 2 3", "f 6 7 8"]))
    return path


def _problem(cube, away, margin, goal=(-1.0, 0.0, 0.0)):
    """The cube, its corner ``away`` from the centre of the arm's last sphere."""
    cube = {"type": "mesh", "path": str(cube), "position": (END + away).tolist()}
    return Problem.from_dict(
        {
            "robot": "planar3",
            "start": [0.0, 0.0, 0.0],
            "goal": {"joints": list(goal)},
            "obstacles": [cube],
            "margin": margin,
        }
    )


# between the directions of the planes, where the hull's distance is short by most
DIRECTION = np.array([1.0, np.tan(np.pi / 8), np.tan(np.pi / 8)])


@pytest.mark.parametrize("margin", [0.0, 0.3])
def test_a_start_near_a_corner_is_infeasible_only_if_it_is_too_close(cube, margin):
    unit = DIRECTION / np.linalg.norm(DIRECTION)
    least = RADIUS + margin
    allowed = plan(_problem(cube, unit * least * 1.01, margin), max_explorations=50)
    refused = plan(_problem(cube, unit * least * 0.99, margin), max_explorations=50)
    assert allowed.status != "infeasible"
    assert refused.status == "infeasible"
    clearance = refused.witness["clearance"]
    assert clearance == pytest.approx(0.99 * least - RADIUS, abs=1e-9)


def test_touching_within_rounding_is_no_proof():
    wall = {
        "type": "halfspace",
        "normal": [0.0, -1.0, 0.0],
        "offset": -(RADIUS + 0.1 - 1e-12),
    }
    data = {
        "robot": "planar3",
        "start": [0.0, 0.0, 0.0],
        "goal": {"joints": [-1.0, 0.0, 0.0]},
        "obstacles": [wall],
        "margin": 0.1,
    }
    assert _blocked(Problem.from_dict(data)) is None
    nearer = _blocked(Problem.from_dict(data | {"margin": 0.1 + 1e-6}))
    assert nearer is not None
    assert nearer.witness["clearance"] == pytest.approx(0.1, abs=1e-9)


@pytest.mark.parametrize(("overlap", "proved"), [(1e-6, False), (1e-5, True)])
def test_a_goal_is_refused_with_all_postures_that_meet_it(overlap, proved):
    """Three joints of 1e-6 rad move the last sphere by some 5e-6 m."""
    wall = {"type": "halfspace", "normal": [-1.0, 0.0, 0.0]}
    wall["offset"] = -(END[0] + RADIUS - overlap)
    data = {
        "robot": "planar3",
        "start": [2.0, 0.0, 0.0],
        "goal": {"joints": [0.0, 0.0, 0.0]},
        "obstacles": [wall],
        "margin": 0.0,
    }
    problem = Problem.from_dict(data)
    stretched = np.zeros(3)
    assert _blocked(problem, stretched) is not None
    found = _blocked(problem, stretched, within=1e-6)
    assert (found is not None) == proved


def _blocked(problem, q=None, within=0.0):
    q = problem.start if q is None else q
    settings = PLANNERS["random-rnn"]
    runtime = runtime_for(problem.robot, settings)
    with open_search(runtime, settings, pack(problem, (), (), 0)) as search:
        return blocked(problem, search, q, "posture", within=within)


def test_explorations_are_random_and_heuristic_ones(cube):
    stats = plan(_problem(cube, np.array([0.3, 0.3, 0.3]), 0.0)).stats
    assert stats.explorations == stats.random + stats.heuristic > 0
    assert stats.to_dict()["explorations"] == stats.explorations
