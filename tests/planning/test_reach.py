"""Plans among hulls, clouds and very many obstacles, and with held objects."""

import json

import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.check import certify_trajectory
from rrnn_opt.errors import DocumentError, ProblemError
from rrnn_opt.planning import Problem
from rrnn_opt.planning.problem.attached import with_attached


def box_obj(path, size, position):
    corners = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T
    points = 0.5 * np.array(size) * corners + position
    path.write_text("\n".join("v {} {} {}".format(*p) for p in points))
    return path


def hulls_of(problem, folder):
    """The problem with every box as a mesh file of its corners."""
    meshes = []
    for k, o in enumerate(problem["obstacles"]):
        path = box_obj(folder / f"{k}.obj", o["size"], o["position"])
        meshes.append({"name": o["name"], "type": "mesh", "path": path.name})
    return {**problem, "obstacles": meshes}


def wall_points(problem, spacing):
    """The window's wall as points, without those in its boxes' hole."""
    found = []
    for o in problem["obstacles"]:
        half = 0.5 * np.array(o["size"])
        axes = [
            np.linspace(p - h, p + h, max(2, int(np.ceil(2 * h / spacing))))
            for p, h in zip(o["position"], half, strict=True)
        ]
        found.append(np.array(np.meshgrid(*axes)).reshape(3, -1).T)
    points = np.concatenate(found)
    return points[np.all(np.abs(points - [0.42, 0, 0.5]) < 0.9, axis=1)]


def test_a_window_of_hulls_is_planned_like_one_of_boxes(tmp_path, window_problem):
    (tmp_path / "problem.json").write_text(
        json.dumps(hulls_of(window_problem(), tmp_path))
    )
    problem = Problem.load(tmp_path / "problem.json")
    for seed in range(3):
        result = rr.plan(problem, seed=seed)
        assert result.status == "solved", result.message
        boxes = {**result.problem, "obstacles": window_problem()["obstacles"]}
        same = certify_trajectory(result.robot, boxes, result.trajectory)
        assert same.collision_free == "PROVED"


def test_hulls_and_boxes_have_the_same_near_pairs(
    tmp_path, pa10_runtime, window_problem, open_search, rng
):
    """On the faces' side a hull of a box is the box."""
    problems = [
        Problem.from_dict(window_problem()),
        Problem.from_dict(hulls_of(window_problem(), tmp_path), base_dir=tmp_path),
    ]
    with (
        open_search(pa10_runtime, problems[0]) as boxes,
        open_search(pa10_runtime, problems[1]) as hulls,
    ):
        for _ in range(200):
            q = rng.uniform(-2, 2, 7)
            a, b = boxes.closest(q, 0.05), hulls.closest(q, 0.05)
            if a is not None and a.gap < 0.0:
                assert b is not None
                assert b.gap <= a.gap + 1e-9


def test_a_cloud_stands_for_a_wall(tmp_path, window_problem):
    points = wall_points(window_problem(), 0.02)
    np.save(tmp_path / "wall.npy", points)
    cloud = {"name": "wall", "type": "points", "path": "wall.npy", "radius": 0.006}
    data = window_problem(obstacles=[cloud])
    problem = Problem.from_dict(data, base_dir=tmp_path)
    assert len(points) > 15_000
    result = rr.plan(problem, seed=2)
    assert result.status == "solved", result.message
    q = np.array(result.trajectory["q"])
    crossed = {**cloud, "path": str(tmp_path / "x.npy")}
    through = {**result.problem, "obstacles": [crossed]}
    position = rr.Kinematics(problem.robot).functions()["position"]
    tips = np.array([np.array(position(row)).ravel() for row in q])
    crossing = tips[np.argmin(np.abs(tips[:, 0] - 0.42))]
    np.save(tmp_path / "x.npy", np.vstack([points, crossing]))
    again = certify_trajectory(result.robot, through, result.trajectory)
    assert again.collision_free == "REFUTED"
    assert again.witness["pair"][1] == "wall"


def test_the_tree_changes_no_plan(window_problem, pa10_runtime, open_search, rng):
    """Postures are free with the tree exactly if they are without it."""
    extra = [
        {"name": f"e{k}", "type": "sphere", "radius": 0.03, "position": p.tolist()}
        for k, p in enumerate(rng.uniform(-1, 1.4, (300, 3)))
    ]
    walls = window_problem()["obstacles"]
    whole = Problem.from_dict(window_problem(obstacles=walls + extra))
    assert whole.solids.flat == 0
    q = rng.uniform(-2.0, 2.0, (400, 7))
    with open_search(pa10_runtime, whole) as search:
        found = search.postures_free(q)
        gaps = [search.closest(row, 0.3) for row in q]
    parts = np.ones(len(q), dtype=bool)
    for k in range(0, len(extra), 12):
        part = Problem.from_dict(window_problem(obstacles=walls + extra[k : k + 12]))
        assert len(part.solids.size) == 0
        with open_search(pa10_runtime, part) as search:
            parts &= search.postures_free(q)
    np.testing.assert_array_equal(found, parts)
    assert 0 < found.sum() < len(q)
    for free, gap in zip(found, gaps, strict=True):
        assert free == (gap is None or gap.gap >= 0.0)


STICK = {
    "frame": "flange",
    "name": "stick",
    "type": "cylinder",
    "radius": 0.01,
    "length": 0.06,
    "position": [0.0, 0.0, 0.03],
}


def test_a_held_object_is_a_link_of_its_own(window_problem):
    problem = Problem.from_dict(window_problem(attached=[STICK]))
    bare = Problem.from_dict(window_problem())
    stick = [s for s in problem.robot.spheres if s.link == "stick"]
    joint = problem.robot.frame("flange").joint
    assert stick
    assert {s.joint for s in stick} == {joint}
    others = {s.link for s in bare.robot.spheres if s.joint != joint}
    paired = {a for a, b in problem.robot.self_pairs if b == "stick"}
    assert paired == others
    again = Problem.from_dict(problem.to_dict())
    assert again.robot.to_dict() == problem.robot.to_dict()
    assert with_attached(problem.robot, ()).to_dict() == bare.robot.to_dict()


BALL = {"name": "ball", "type": "sphere", "radius": 0.03}


def swing(pa10):
    """A turn of the base past a ball that only what is held can touch."""
    posture = [0.0, 0.3, 0.0, 0.8, 0.0, 0.4, 0.0]
    middle = np.array([0.6, *posture[1:]])
    pose = np.array(rr.Kinematics(pa10).functions()["pose"](middle))
    ball = pose[:3, 3] + 0.25 * pose[:3, 2]
    return {
        "robot": "pa10",
        "start": posture,
        "goal": {"joints": [1.2, *posture[1:]]},
        "obstacles": [
            {
                "name": "ball",
                "type": "sphere",
                "radius": 0.03,
                "position": ball.tolist(),
            }
        ],
    }


def test_a_held_stick_collides_where_the_bare_hand_does_not(pa10):
    data = swing(pa10)
    bare = rr.plan(Problem.from_dict(data), seed=1)
    assert bare.status == "solved"
    stick = {**STICK, "length": 0.3, "position": [0.0, 0.0, 0.17]}
    held = Problem.from_dict({**data, "attached": [stick]})
    naked = certify_trajectory(held.robot.to_dict(), held.to_dict(), bare.trajectory)
    assert naked.collision_free == "REFUTED"
    assert naked.witness["pair"] == ["stick", "ball"]
    result = rr.plan(held, seed=1)
    assert result.status == "solved", result.message
    block, problem = held.robot.to_dict(), held.to_dict()
    assert certify_trajectory(block, problem, result.trajectory).proved


def test_a_block_without_the_held_object_is_not_judged(window_problem):
    held = Problem.from_dict(window_problem(attached=[STICK]))
    bare = rr.plan(Problem.from_dict(window_problem()), seed=1)
    with pytest.raises(DocumentError, match="no sphere of the robot stands for it"):
        certify_trajectory(bare.robot, held.to_dict(), bare.trajectory)


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"frame": "nowhere"}, "attached[0].frame"),
        ({"name": "flange"}, "attached[0].name"),
        ({"type": "halfspace"}, "attached[0].radius"),
        ({"radius": -1}, "attached[0].radius"),
    ],
)
def test_objects_that_cannot_be_held_are_refused(window_problem, change, field):
    with pytest.raises(ProblemError) as caught:
        Problem.from_dict(window_problem(attached=[{**STICK, **change}]))
    assert caught.value.field == field
