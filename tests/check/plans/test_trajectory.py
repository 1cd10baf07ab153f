"""Verdicts on whole trajectories; oracles are planted bugs, coal, dense samples.

Dense sampling is never a certificate: here it only tries to catch one lying.
"""

import coal
import numpy as np
import pytest

from rrnn_opt.check import certify_trajectory
from rrnn_opt.check.plans.robot import kinematics
from rrnn_opt.check.plans.robot.block import read_model
from rrnn_opt.errors import DocumentError
from rrnn_opt.motion import Trajectory
from tests.check.plans.motions import box, centres_at, judge, swing


def test_a_free_swing_is_proved_with_a_close_clearance(planar):
    wall = box((2.4, 0.0, 0.0), (0.2, 0.2, 0.2))  # 0.25 m beyond the outer sphere
    motion = swing(planar, [-1.0, 0.0], [1.0, 0.0])
    found = judge(planar, [wall], motion)
    assert found.collision_free == found.limits == "PROVED"
    assert found.proved
    assert 0.25 * 0.89 - 1e-3 <= found.clearance_lower_bound <= 0.25


def test_planted_a_thin_wall_between_rows(planar):
    """Two rows, both far from a 2 mm wall that the arm sweeps through."""
    wall = box((2.0, 0.0, 0.0), (0.6, 0.002, 0.3))
    motion = swing(planar, [-1.0, 0.0], [1.3, 0.0])
    ends = centres_at(planar, motion, motion.t)
    assert np.abs(ends[:, 2, 1]).min() > 0.5
    found = judge(planar, [wall], motion)
    assert found.collision_free == "REFUTED"
    assert found.witness["pair"] in (["lower", "wall"], ["upper", "wall"])
    assert found.witness["distance"] < 0


@pytest.mark.parametrize(("dent", "verdict"), [(1e-4, "REFUTED"), (-1e-4, "PROVED")])
def test_planted_a_touch_of_a_tenth_of_a_millimetre(planar, dent, verdict):
    """The tip's arc bulges 0.1 mm into a plane, between two rows."""
    plane = {"type": "halfspace", "normal": [-1.0, 0.0, 0.0], "offset": -2.05 + dent}
    motion = swing(planar, [-0.7, 0.0], [0.9, 0.0])
    found = judge(planar, [plane], motion)
    assert found.collision_free == verdict
    if verdict == "REFUTED":
        assert -dent <= found.witness["distance"] < 0
        assert 0 < found.witness["time"] < motion.duration


def test_planted_a_shift_of_two_centimetres(planar):
    """A proved trajectory, delivered with its base joint turned 2 cm at the tip."""
    wall = box((2.0 * np.cos(1.0), 2.0 * np.sin(1.0) + 0.155, 0.0), (0.2, 0.2, 0.2))
    motion = swing(planar, [-1.0, 0.0], [1.0, 0.0])
    assert judge(planar, [wall], motion).collision_free == "PROVED"
    shifted = Trajectory.from_rows(
        motion.t, motion.q + np.array([0.01, 0.0]), motion.qd
    )
    found = judge(planar, [wall], shifted, start=[-1.0, 0.0])
    assert found.collision_free == "REFUTED"
    assert "start" in found.faults[0]
    assert not found.proved


def test_a_witness_is_a_true_collision_by_coal(planar):
    wall = box((2.0, 0.1, 0.0), (0.6, 0.002, 0.3))
    found = judge(planar, [wall], swing(planar, [-1.0, 0.0], [1.3, 0.0]))
    model, q = read_model(planar), np.array(found.witness["q"])[:, None]
    spheres = kinematics.sphere_centres(model, kinematics.forward(model, q))[..., 0].T
    i = model.links.index(found.witness["pair"][0])
    place = coal.Transform3s(np.eye(3), np.array(wall["position"]))
    hit = coal.collide(
        coal.Sphere(model.radii[i]),
        coal.Transform3s(np.eye(3), spheres[i]),
        coal.Box(*wall["size"]),
        place,
        coal.CollisionRequest(),
        coal.CollisionResult(),
    )
    assert hit


def test_self_collision_is_refuted_and_its_absence_proved(planar):
    folding = swing(planar, [0.0, 0.0], [0.0, 3.1])  # the tip comes back to the base
    found = judge(planar, [], folding)
    assert found.collision_free == "REFUTED"
    assert found.witness["pair"] == ["base", "lower"]
    found = judge(planar, [], swing(planar, [0.0, 0.0], [0.0, 3.0]))
    assert found.collision_free == "PROVED"
    away = 2 * np.cos(1.5) - 0.1
    assert away - 1.1e-3 <= found.clearance_lower_bound <= away


def test_margin_is_for_obstacles_only(planar):
    wall = box((2.4, 0.0, 0.0), (0.2, 0.2, 0.2))
    motion = swing(planar, [-1.0, 0.0], [1.0, 0.0])
    assert judge(planar, [wall], motion, margin=0.24).collision_free == "PROVED"
    found = judge(planar, [wall], motion, margin=0.26)
    assert found.collision_free == "REFUTED"
    assert found.witness["required"] == 0.26
    assert found.witness["distance"] > 0
    near = swing(planar, [0.0, 0.0], [0.0, 3.0])  # 4 cm from itself
    assert judge(planar, [], near, margin=0.5).collision_free == "PROVED"


def test_what_cannot_move_may_stand_in_an_obstacle(planar):
    table = box((0.0, 0.0, 0.0), (0.3, 0.3, 0.3))
    motion = swing(planar, [-1.0, 0.0], [1.0, 0.0])
    assert judge(planar, [table], motion).collision_free == "PROVED"


def test_a_spent_budget_is_unknown_never_proved(planar):
    plane = {"type": "halfspace", "normal": [-1.0, 0.0, 0.0], "offset": -2.05 - 1e-6}
    motion = swing(planar, [-0.7, 0.0], [0.9, 0.0])
    problem = {"obstacles": [plane]}
    found = certify_trajectory(planar, problem, motion.to_dict(), max_boxes=3)
    assert found.collision_free == "UNKNOWN"
    assert found.clearance_lower_bound is None
    assert not found.proved
    assert judge(planar, [plane], motion).collision_free == "PROVED"


def test_limits_are_judged_between_rows(planar):
    """Rows are inside all limits, the cubic between them is not."""
    t, q = [0.0, 1.0, 2.0], [[0.0, 0.0], [2.9, 0.0], [0.0, 0.0]]
    good = Trajectory.from_rows([0.0, 5.0, 10.0], q, np.zeros((3, 2)))
    assert judge(planar, [], good).limits == "PROVED"
    fast = Trajectory.from_rows(t, q, np.zeros((3, 2)))  # peak 4.35 rad/s
    found = judge(planar, [], fast)
    assert found.limits == "REFUTED"
    assert found.limits_witness["kind"] == "velocity"
    assert abs(found.limits_witness["value"]) == pytest.approx(4.35)
    rates = [[0.0, 0.0], [0.5, 0.0], [0.0, 0.0]]  # passes 2.9 and overshoots 3.0
    over = Trajectory.from_rows([0.0, 5.0, 10.0], q, rates)
    found = judge(planar, [], over)
    assert found.limits_witness["kind"] == "position"
    assert found.limits_witness["value"] > 3.0


def test_acceleration_is_judged_at_both_ends_of_a_piece(planar):
    motion = swing(planar, [0.0, 0.0], [1.0, 0.0])  # accelerates with 10 rad/s2
    assert judge(planar, [], motion).limits == "PROVED"
    found = judge(planar, [], motion.stretched(1 - 1e-6))
    assert found.limits == "REFUTED"
    assert found.limits_witness["kind"] == "acceleration"


def test_goals(planar):
    motion = swing(planar, [0.0, 0.0], [1.0, 0.5])
    place = [np.cos(1.0) + np.cos(1.5), np.sin(1.0) + np.sin(1.5), 0.0]
    quat = [0.0, 0.0, np.sin(0.75), np.cos(0.75)]
    pose = {"position": place, "quat_xyzw": quat}
    for goal in ({"joints": [1.0, 0.5]}, {"position": place}, pose):
        found = judge(planar, [], motion, goal=goal)
        assert found.goal_reached
        assert found.goal_error < 1e-12
    assert found.goal_angle_error < 1e-12
    off = [place[0] + 2e-3, place[1], 0.0]
    found = judge(planar, [], motion, goal={"position": off})
    assert not found.goal_reached
    assert found.goal_error == pytest.approx(2e-3)
    assert not found.proved
    assert judge(planar, [], motion, goal={"position": off, "tolerance": 0.01}).proved
    either = [{"position": off}, {"joints": [1.0, 0.5]}]
    assert judge(planar, [], motion, goal=either).goal_error == 0.0
    assert not judge(planar, [], motion, goal={"joints": [1.0, 0.5 + 2e-6]}).proved


def test_an_angle_of_the_goal_counts(planar):
    motion = swing(planar, [0.0, 0.0], [1.0, 0.5])
    place = [np.cos(1.0) + np.cos(1.5), np.sin(1.0) + np.sin(1.5), 0.0]
    for angle, reached in ((0.009, True), (0.011, False), (np.pi, False)):
        half = (1.5 + angle) / 2
        quat = [0.0, 0.0, np.sin(half), np.cos(half)]
        found = judge(planar, [], motion, goal={"position": place, "quat_xyzw": quat})
        assert found.goal_angle_error == pytest.approx(angle, abs=1e-9)
        assert found.goal_reached is reached


def test_a_continuous_joint_reaches_its_goal_modulo_a_turn(tree):
    motion = swing(tree, [0.0, 0.0, 0.0, 0.0], [0.1, 0.1, 0.1, 0.3])
    goal = np.array([0.1, 0.1, 0.1, 0.3 - 4 * np.pi])
    assert judge(tree, [], motion, goal={"joints": goal.tolist()}).goal_error < 1e-12
    goal = [0.1 + 2 * np.pi, 0.1, 0.1, 0.3]
    assert judge(tree, [], motion, goal={"joints": goal}).goal_error > 6


def test_faults_of_the_rows(planar):
    motion = swing(planar, [0.0, 0.0], [1.0, 0.5])
    rows = motion.to_dict()
    assert certify_trajectory(planar, {}, rows).faults == ()
    for change, word in (
        ({"qdd": (motion.qdd + 1e-3).tolist()}, "qdd"),
        ({"duration": 7.0}, "duration"),
        ({"qd": (motion.qd + 1e-3).tolist(), "qdd": None}, "rest"),
    ):
        found = certify_trajectory(planar, {}, {**rows, **change})
        assert any(word in fault for fault in found.faults)
        assert not found.proved


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"t": [0.0, 1.0, 1.0]}, "increase"),
        ({"t": [0.1, 1.0, 2.0]}, "zero"),
        ({"t": [0.0, float("nan"), 2.0]}, "finite"),
        ({"t": [0.0]}, "two rows"),
        ({"q": [[0.0, 0.0]]}, "trajectory.q"),
        ({"qd": [["0", 0.0]] * 3}, "numbers"),
        ({"qdd": [[0.0]]}, "trajectory.qdd"),
    ],
)
def test_malformed_rows_are_refused(planar, change, field):
    rows = {"t": [0.0, 1.0, 2.0], "q": [[0.0, 0.0]] * 3, "qd": [[0.0, 0.0]] * 3}
    with pytest.raises(DocumentError, match=field):
        certify_trajectory(planar, {}, {**rows, **change})


def test_what_cannot_be_judged_is_refused(planar):
    motion = swing(planar, [0.0, 0.0], [1.0, 0.5]).to_dict()
    for problem, field in (
        ({"attached": [{"frame": "tip", "type": "sphere"}]}, "attached"),
        ({"frame": "elbow"}, "frame"),
        ({"margin": -1.0}, "margin"),
        ({"obstacles": {}}, "obstacles"),
        ({"goal": []}, "goal"),
    ):
        with pytest.raises(DocumentError, match=field):
            certify_trajectory(planar, problem, motion)


def test_a_dict_of_it_is_the_contracts_certificate(planar):
    import json

    found = judge(planar, [], swing(planar, [0.0, 0.0], [1.0, 0.5])).to_dict()
    again = json.loads(json.dumps(found, allow_nan=False))
    names = "collision_free limits clearance_lower_bound goal_error"
    for name in (*names.split(), "goal_angle_error", "method", "checks", "time_s"):
        assert name in again
