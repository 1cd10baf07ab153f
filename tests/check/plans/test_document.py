"""Plan documents: what holds, what is overstated, and what is no document."""

import copy
import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rrnn_opt.check import certify_trajectory, check_plan
from rrnn_opt.errors import DocumentError, RrnnError
from rrnn_opt.motion import stop_and_go


class Speeds:
    lower, upper = np.full(2, -3.0), np.full(2, 3.0)
    velocity, acceleration = np.full(2, 2.0), np.full(2, 10.0)


@pytest.fixture
def plan(planar):
    """A solved plan as read from its file."""
    motion = stop_and_go([[-1.0, 0.0], [1.0, 0.0]], Speeds())
    problem = {
        "robot": "planar",
        "frame": "tip",
        "start": [-1.0, 0.0],
        "goal": {"joints": [1.0, 0.0]},
        "obstacles": [
            {
                "type": "box",
                "name": "b",
                "size": [0.2, 0.2, 0.2],
                "position": [2.4, 0, 0],
            },
            {"type": "halfspace", "name": "g", "normal": [0, 0, 1], "offset": -0.2},
            {"type": "capsule", "radius": 0.1, "length": 0.2, "position": [0, 0, 2]},
        ],
        "margin": 0.01,
    }
    found = certify_trajectory(planar, problem, motion.to_dict())
    document = {
        "status": "solved",
        "message": "trajectory found and proved",
        "path": [[-1.0, 0.0], [1.0, 0.0]],
        "trajectory": motion.to_dict(),
        "certificate": found.to_dict(),
        "problem": problem,
        "robot": planar,
        "seed": 0,
    }
    return json.loads(json.dumps(document))


def test_a_solved_plan_holds(plan):
    found = check_plan(plan)
    assert found.holds
    assert found.disagreements == ()
    json.dumps(found.to_dict(), allow_nan=False)


def test_a_shifted_trajectory_does_not_hold(plan):
    plan["trajectory"]["q"] = [[a, b + 0.05] for a, b in plan["trajectory"]["q"]]
    found = check_plan(plan)
    assert not found.holds
    assert any("solved" in line for line in found.disagreements)


def test_an_obstacle_put_in_the_way_does_not_hold(plan):
    plan["problem"]["obstacles"][0]["position"] = [2.0, 0.0, 0.0]
    found = check_plan(plan)
    assert not found.holds
    assert found.certificate.collision_free == "REFUTED"
    assert any("collision_free PROVED" in line for line in found.disagreements)


@pytest.mark.parametrize(
    ("key", "value"), [("clearance_lower_bound", 0.9), ("goal_error", 0.1)]
)
def test_an_overstated_number_does_not_hold(plan, key, value):
    plan["certificate"][key] = value
    found = check_plan(plan)
    assert found.certificate.proved
    assert not found.holds
    assert any(key in line for line in found.disagreements)


def test_without_a_trajectory_nothing_holds(plan):
    plan["trajectory"] = None
    assert check_plan(plan).disagreements
    plan["status"] = "budget_exhausted"
    found = check_plan(plan)
    assert not found.holds
    assert found.disagreements == ()
    assert found.to_dict()["certificate"] is None


@pytest.mark.parametrize("document", [None, 3, [], "x", {}, {"status": 1}])
def test_no_plan_at_all_is_refused(document):
    with pytest.raises(DocumentError):
        check_plan(document)


@pytest.mark.parametrize("key", ["robot", "problem"])
def test_a_missing_part_is_named(plan, key):
    del plan[key]
    with pytest.raises(DocumentError, match=key):
        check_plan(plan)


def places(value, path=()):
    """Every place in a document."""
    yield path
    items = ()
    if isinstance(value, dict):
        items = value.items()
    elif isinstance(value, list):
        items = enumerate(value)
    for key, inner in items:
        yield from places(inner, (*path, key))


JUNK = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-3, 3),
    st.just(10**400),
    st.floats(allow_nan=True, allow_infinity=True),
    st.sampled_from(["", "solved", "1.0", "revolute"]),
    st.just([]),
    st.just({}),
    st.just([[]]),
    st.lists(st.floats(-1, 1), max_size=4),
    st.just([[1.0, 2.0], [3.0]]),
    st.just({"joints": None}),
)


@settings(max_examples=400)
@given(data=st.data())
def test_only_our_own_errors_come_out(data, request):
    plan = copy.deepcopy(request.getfixturevalue("plan"))
    for _ in range(data.draw(st.integers(1, 2))):
        path = data.draw(st.sampled_from(list(places(plan))[1:]))
        owner = plan
        for key in path[:-1]:
            owner = owner[key]
        if data.draw(st.booleans()):
            owner[path[-1]] = data.draw(JUNK)
        else:
            del owner[path[-1]]
    try:
        found = check_plan(plan)
    except RrnnError:
        return
    assert isinstance(found.holds, bool)
    json.dumps(found.to_dict(), allow_nan=False)


def test_a_robot_without_spheres_proves_nothing():
    """An empty body is free of collisions only in words."""
    import rrnn_opt as rr
    from rrnn_opt.scene.library import scenario

    plan = rr.plan(rr.Problem.from_dict(scenario("plane").problem(0))).to_dict()
    plan["robot"]["spheres"] = []
    with pytest.raises(DocumentError, match=r"robot\.spheres"):
        check_plan(plan)
