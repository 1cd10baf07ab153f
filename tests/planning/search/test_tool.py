"""A goal that the tool itself cannot take is infeasible, and only then."""

import coal
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import rrnn_opt as rr
from rrnn_opt.planning import Problem, plan
from rrnn_opt.planning.search.tool import tool_blocked

READY = [0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785]
DOWN = {"position": [0.5, 0.0, 0.4], "quat_xyzw": [1.0, 0.0, 0.0, 0.0]}
BLOCK = {"name": "block", "type": "box", "size": [0.3] * 3, "position": [0.5, 0, 0.4]}


def problem_of(goal, *obstacles, **more):
    rest = {"robot": "panda", "start": READY, "goal": goal}
    return Problem.from_dict({**rest, "obstacles": list(obstacles), **more})


@pytest.mark.parametrize(
    ("goal", "block", "margin", "words"),
    [
        (DOWN, BLOCK, 0.0, "would overlap 'block' by"),
        ({"position": [0.5, 0.0, 0.4]}, {**BLOCK, "size": [0.5] * 3}, 0.0, "overlap"),
        (DOWN, {**BLOCK, "position": [0.5, 0.0, 0.21]}, 0.05, "less than the margin"),
        ({**DOWN, "region": {"box": [0.02, 0.02, 0.02]}}, BLOCK, 0.0, "overlap"),
        ({**DOWN, "free_axis": "z"}, BLOCK, 0.0, "overlap"),
    ],
)
def test_infeasible_with_what_is_in_the_way(goal, block, margin, words):
    result = plan(problem_of(goal, block, margin=margin))
    assert result.status == "infeasible"
    assert words in result.message
    assert result.witness["other"] == "block"
    assert result.witness["clearance"] < margin


def test_another_goal_that_is_only_not_found_leaves_it_open():
    """The second goal's tool is free; the arm would have to reach through itself."""
    far = {"position": [0.0, 0.0, 0.05], "quat_xyzw": [0.0, 0.0, 0.0, 1.0]}
    assert plan(problem_of([DOWN, far], BLOCK)).status == "no_goal_posture"


@pytest.mark.parametrize("share", [0.0, 0.5])
def test_a_goal_beside_the_block_is_not_closed(share):
    beside = {**DOWN, "region": {"box": [0.0, 0.4 * share, 1.0]}}
    problem = problem_of(beside, BLOCK)
    assert tool_blocked(problem, problem.goals[0]) is None


def drawn(rng, folder):
    """A goal and a solid about it."""
    turn, middle = Rotation.random(random_state=rng), rng.uniform(-0.05, 0.05, 3)
    goal = {"position": [0.5, 0.0, 0.5], "tolerance": rng.uniform(0.001, 0.02)}
    if rng.random() < 0.7:
        goal["quat_xyzw"] = Rotation.random(random_state=rng).as_quat().tolist()
        goal["angle_tolerance"] = rng.uniform(0.01, 0.5)
        if rng.random() < 0.5:
            goal["free_axis"] = str(rng.choice(["x", "y", "z"]))
    if rng.random() < 0.5:
        goal["region"] = {"box": rng.uniform(0.0, 0.1, 3).tolist()}
    name = str(rng.choice(["box", "cylinder", "capsule", "sphere", "mesh"]))
    edges, radius, length = rng.uniform(0.1, 0.6, 3), *rng.uniform(0.1, 0.4, 2)
    where = {"position": (middle + np.array([0.5, 0.0, 0.5])).tolist()}
    pose = {**where, "quat_xyzw": turn.as_quat().tolist()}
    if name == "mesh":
        file = folder / "block.obj"
        signs = np.array(np.meshgrid(*[(-0.5, 0.5)] * 3)).reshape(3, -1).T * edges
        file.write_text("".join(f"v {x} {y} {z}\n" for x, y, z in signs))
        more, shape = {"path": str(file), **pose}, coal.Box(*edges)
    elif name == "box":
        more, shape = {"size": edges.tolist(), **pose}, coal.Box(*edges)
    elif name == "sphere":
        more, shape = {"radius": radius, **where}, coal.Sphere(radius)
    else:
        more = {"radius": radius, "length": length, **pose}
        shape = {"cylinder": coal.Cylinder, "capsule": coal.Capsule}[name](
            radius, length
        )
    placed = coal.Transform3s(turn.as_matrix(), np.array(where["position"]))
    return goal, {"name": "it", "type": name, **more}, shape, placed


def meeting(goal, rng):
    """A random pose of the tip that meets the goal: rotation and position."""
    wanted = Rotation.from_quat(goal.quat_xyzw) if goal.quat_xyzw is not None else None
    axes = np.eye(3) if wanted is None else wanted.as_matrix()
    away = rng.normal(size=3)
    away *= goal.tolerance * rng.choice([1.0, rng.random()]) / np.linalg.norm(away)
    inside = rng.uniform(-1.0, 1.0, 3) if rng.random() < 0.5 else rng.choice([-1, 1], 3)
    position = goal.position + axes @ (inside * goal.half_edges) + away
    if wanted is None:
        return Rotation.random(random_state=rng).as_matrix(), position
    tilt = rng.normal(size=3)
    tilt *= goal.angle_tolerance * rng.random() / np.linalg.norm(tilt)
    turn = wanted * Rotation.from_rotvec(tilt)
    if goal.free_axis is not None:
        about = np.eye(3)["xyz".index(goal.free_axis)] * rng.uniform(-np.pi, np.pi)
        turn = turn * Rotation.from_rotvec(about)
    return turn.as_matrix(), position


def test_no_pose_that_meets_a_closed_goal_is_free(rng, tmp_path):
    """Coal finds the named link too near, wherever the tip meets the goal."""
    robot, closed = rr.Robot.builtin("panda"), 0
    tip = robot.frame(None)
    turn, origin = tip.placement[:3, :3], tip.placement[:3, 3]
    for _ in range(40):
        goal, block, shape, placed = drawn(rng, tmp_path)
        problem = problem_of(goal, block, margin=float(rng.choice([0.0, 0.02])))
        proof = tool_blocked(problem, problem.goals[0])
        if proof is None:
            continue
        closed += 1
        for _ in range(20):
            rotation, position = meeting(problem.goals[0], rng)
            gaps = []
            for sphere in robot.spheres:
                if sphere.joint != tip.joint or sphere.link != proof.witness["link"]:
                    continue
                centre = position + rotation @ turn.T @ (sphere.center - origin)
                at = coal.Transform3s(np.eye(3), centre)
                gaps.append(
                    coal.distance(
                        coal.Sphere(sphere.radius),
                        at,
                        shape,
                        placed,
                        coal.DistanceRequest(),
                        coal.DistanceResult(),
                    )
                )
            assert min(gaps) <= proof.witness["clearance"] + 1e-5
    assert 5 < closed < 40
