"""The subdivision itself: batches, budgets, and what it may say."""

import numpy as np
import pytest

from rrnn_opt.check import certify_trajectory
from rrnn_opt.check.plans.collision import worklist
from rrnn_opt.motion import Trajectory
from rrnn_opt.robot import Robot

WALL = {"type": "box", "name": "w", "size": [0.1, 0.1, 0.1], "position": [0.9, 0.9, 0]}


def cases():
    arm = Robot.builtin("planar3")
    robot, rng = arm.to_dict(), np.random.default_rng(2)
    for _ in range(8):
        q, qd = rng.uniform(-2, 2, (4, 3)), rng.normal(size=(4, 3))
        qd[[0, -1]] = 0
        yield robot, Trajectory.from_rows([0.0, 1.0, 2.0, 3.0], q, qd).to_dict()


@pytest.mark.parametrize("rows", [1, 50, 3000])
def test_batches_decide_nothing(rows, monkeypatch):
    """Memory limits change the order of work, not what is found."""
    plain = [certify_trajectory(r, {"obstacles": [WALL]}, t) for r, t in cases()]
    assert {c.collision_free for c in plain} == {"PROVED", "REFUTED"}
    monkeypatch.setattr(worklist, "ROWS", rows)
    for (robot, rows_), before in zip(cases(), plain, strict=True):
        after = certify_trajectory(robot, {"obstacles": [WALL]}, rows_)
        assert after.collision_free == before.collision_free
        if before.clearance_lower_bound is not None:
            near = pytest.approx(before.clearance_lower_bound, rel=0.15, abs=1.5e-3)
            assert after.clearance_lower_bound == near


@pytest.mark.parametrize("boxes", [1, 2, 5, 20])
def test_a_small_budget_never_changes_a_proof_into_another_verdict(boxes):
    for robot, rows in cases():
        problem = {"obstacles": [WALL]}
        full = certify_trajectory(robot, problem, rows)
        part = certify_trajectory(robot, problem, rows, max_boxes=boxes)
        assert part.collision_free in (full.collision_free, "UNKNOWN")
        if part.collision_free == "PROVED":
            assert part.clearance_lower_bound <= full.clearance_lower_bound + 1e-12


def test_without_pairs_there_is_nothing_to_prove():
    robot, rows = next(cases())
    found = certify_trajectory({**robot, "self_pairs": []}, {}, rows)
    assert found.collision_free == "PROVED"
    assert found.clearance_lower_bound is None
    assert found.checks == 0


def test_the_slack_is_kept():
    """What rounding could have done is neither proved nor refuted."""
    robot, _ = next(cases())
    still = Trajectory.from_rows([0, 1.0], np.zeros((2, 3)), np.zeros((2, 3))).to_dict()
    ball = {"type": "sphere", "radius": 0.1, "position": [0.3, 0.2, 0.0]}
    robot = {**robot, "self_pairs": []}
    least = certify_trajectory(robot, {"obstacles": [ball]}, still)
    gap, room = least.clearance_lower_bound, least.rounding_bound_m
    assert 0 < room < 1e-12
    for more, verdict in ((-1, "PROVED"), (0.5, "UNKNOWN"), (4, "REFUTED")):
        problem = {"obstacles": [ball], "margin": gap + more * room}
        found = certify_trajectory(robot, problem, still, max_boxes=50)
        assert found.collision_free == verdict
