"""A planner with one deliberate bug delivers what the checker must refute.

The bug is planted in the formulas that the planner's C code is emitted from;
the same runs without it are all proved, so it is the bug that is caught.
"""

import dataclasses

import casadi as ca
import numpy as np
import pytest

from rrnn_opt.check import certify_trajectory
from rrnn_opt.motion import Trajectory, stop_and_go
from rrnn_opt.networks import MemoryCell
from rrnn_opt.planning import Problem, RandomRnn
from rrnn_opt.planning.kernel import source as kernel
from rrnn_opt.planning.search.library import Runtime, Search
from rrnn_opt.planning.search.request import pack
from rrnn_opt.robot import Robot

ARM = Robot.builtin("planar3")
SETTINGS = RandomRnn(steering_margin=0.0)


def open_search(runtime, problem, seed=0):
    joints = tuple(goal.joints for goal in problem.goals)
    packed = pack(problem, joints, (), seed)
    return Search(runtime, SETTINGS, packed.struct, packed.keep)


def clutter(seed, n=7):
    rng = np.random.default_rng(seed)
    places = (p for p in rng.uniform(-2, 2, (100, 2)) if np.hypot(*p) > 0.5)
    boxes = [
        {
            "name": f"box{k}",
            "type": "box",
            "position": [*next(places).tolist(), 0.0],
            "size": [*rng.uniform(0.05, 0.3, 2).tolist(), 0.2],
        }
        for k in range(n)
    ]
    start, goal = rng.uniform(-2.5, 2.5, (2, 3)).tolist()
    rest = {"robot": "planar3", "start": start, "goal": {"joints": goal}}
    return {**rest, "obstacles": boxes}


def verdict(robot, obstacles, rows):
    found = certify_trajectory(
        robot.to_dict(), {"obstacles": obstacles}, rows.to_dict(), max_boxes=20_000
    )
    return found.collision_free


def free(obstacles, q):
    rows = Trajectory.from_rows([0.0, 1.0], [q, q], np.zeros((2, 3)))
    return verdict(ARM, obstacles, rows) == "PROVED"


def delivered(runtime, shrink=0.0, seeds=range(24)):
    """Verdicts on the paths of a planner that sees obstacles shrunk by so much."""
    found = []
    for seed in seeds:
        data = clutter(seed)
        true = data["obstacles"]
        if not all(free(true, q) for q in (data["start"], data["goal"]["joints"])):
            continue
        seen = [{**box, "size": [a - 2 * shrink for a in box["size"]]} for box in true]
        problem = Problem.from_dict({**data, "obstacles": seen})
        with open_search(runtime, problem, seed) as search:
            if search.run(200, 5.0) == "solved":
                rows = stop_and_go(search.path(), ARM.limits)
                found.append(verdict(ARM, true, rows))
    return found


def one_segment(runtime, robot, gap):
    """What planner and checker say of a swing by 0.1 rad to both sides.

    The stretched arm's tip dips by 2.4 (1 - cos 0.1) = 12 mm at both ends,
    towards a face that is ``gap`` below it in the middle.
    """
    face = {"name": "f", "type": "halfspace", "normal": [1.0, 0.0, 0.0]}
    obstacles = [{**face, "offset": 2.4 - robot.spheres[0].radius - gap}]
    still = {"start": [0.0, 0.0, 0.0], "goal": {"joints": [0.0, 0.0, 0.0]}}
    problem = Problem.from_dict({"robot": "planar3", "obstacles": obstacles, **still})
    ends = np.array([[-0.1, 0.0, 0.0], [0.1, 0.0, 0.0]])
    with open_search(runtime, dataclasses.replace(problem, robot=robot)) as search:
        claimed = search.segment_free(*ends)
    return claimed, verdict(robot, obstacles, stop_and_go(ends, robot.limits))


@pytest.fixture
def tip_only():
    """The arm with a sphere at its tip alone."""
    last = ARM.spheres[-1]
    ball = dataclasses.replace(last, center=np.array([0.6, 0.0, 0.0]))
    return dataclasses.replace(ARM, spheres=(ball,), self_pairs=())


def test_obstacles_seen_3_mm_too_small_are_refuted():
    runtime = Runtime(ARM, MemoryCell())
    assert set(delivered(runtime)) == {"PROVED"}
    assert "REFUTED" in delivered(runtime, shrink=0.003)


def shifted(make, more):
    """A distance function whose first output is ``more`` too large."""

    def planted(kind):
        f = make(kind)
        inputs = [ca.SX.sym(f.name_in(i), *f.size_in(i)) for i in range(f.n_in())]
        d, *rest = f.call(inputs)
        return ca.Function(
            f.name(), inputs, [d + more, *rest], f.name_in(), f.name_out()
        )

    return planted


@pytest.mark.slow
def test_a_distance_3_mm_too_large_is_refuted(monkeypatch):
    for name in ("distance_function", "gap_function"):
        monkeypatch.setattr(kernel, name, shifted(getattr(kernel, name), 0.003))
    assert "REFUTED" in delivered(Runtime(ARM, MemoryCell()))


@pytest.mark.slow
def test_a_jacobian_of_wrong_sign_is_refuted(monkeypatch):
    row = kernel.row
    monkeypatch.setattr(kernel, "row", lambda *args: -row(*args))
    assert "REFUTED" in delivered(Runtime(ARM, MemoryCell()), seeds=range(60))


@pytest.mark.slow
def test_half_a_motion_bound_is_refuted(monkeypatch, tip_only):
    sound = Runtime(tip_only, MemoryCell())
    assert one_segment(sound, tip_only, 0.013) == (True, "PROVED")
    assert one_segment(sound, tip_only, 0.008) == (False, "REFUTED")
    bound = kernel.motion_bound
    monkeypatch.setattr(kernel, "motion_bound", lambda *args: bound(*args) / 2)
    planted = Runtime(tip_only, MemoryCell())
    assert one_segment(planted, tip_only, 0.008) == (True, "REFUTED")
