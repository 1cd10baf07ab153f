"""The problem file: read, defaults filled in, or refused in one sentence."""

import dataclasses
import importlib.metadata
import json
import math

import numpy as np
import pytest

from rrnn_opt.errors import ProblemError, RobotError
from rrnn_opt.planning.problem.goals import JointGoal, TipGoal
from rrnn_opt.planning.problem.problem import Problem
from rrnn_opt.scene import Box, Scene
from rrnn_opt.scene.library import SCENARIOS, scenario
from tests.planning.problem.documents import changed, minimal, one_joint, valid


def test_reads_everything():
    problem = Problem.from_dict(valid())
    assert (problem.robot.name, problem.robot_ref) == ("planar3", "planar3")
    assert (problem.frame, problem.margin) == ("tip", 0.01)
    assert np.array_equal(problem.start, [0.1, 0.2, 0.3])
    joints, point, pose = problem.goals
    assert isinstance(joints, JointGoal)
    assert np.array_equal(joints.joints, [1, 1, 1])
    assert isinstance(point, TipGoal)
    assert point.quat_xyzw is None
    assert (pose.tolerance, pose.angle_tolerance) == (0.01, 0.1)
    names = [o.name for o in problem.scene]
    assert names == ["b", "cylinder1", "capsule2", "sphere3", "halfspace4"]


def test_defaults_are_filled_in():
    data = minimal()
    data["obstacles"] = [{"type": "box", "size": [1, 1, 1], "position": [9, 0, 0]}]
    filled = Problem.from_dict(data).to_dict()
    assert filled == {
        "robot": "planar3",
        "frame": "tip",
        "locked": {},
        "start": [0.0, 0.0, 0.0],
        "goal": {"position": [1.0, 1.0, 0.0], "tolerance": 0.001},
        "obstacles": [
            {
                "name": "box0",
                "type": "box",
                "size": [1.0, 1.0, 1.0],
                "position": [9.0, 0.0, 0.0],
                "quat_xyzw": [0.0, 0.0, 0.0, 1.0],
            }
        ],
        "attached": [],
        "margin": 0.0,
    }


def test_what_is_written_reads_back_the_same():
    once = Problem.from_dict(valid()).to_dict()
    text = json.dumps(once, allow_nan=False)
    assert Problem.from_dict(json.loads(text)).to_dict() == once


def test_a_pose_goal_without_angle_tolerance_gets_the_default():
    goal = {"position": [1, 1, 0], "quat_xyzw": [0, 0, 0, 1]}
    written = Problem.from_dict({**minimal(), "goal": goal}).to_dict()["goal"]
    assert (written["tolerance"], written["angle_tolerance"]) == (0.001, 0.01)


REFUSED = [
    (("robot", ...), "robot", "is missing"),
    (("robot", "planr3"), "robot", "did you mean 'planar3'"),
    (("robot", 3), "robot", "expected a text"),
    (("robot", "no/such.urdf"), "robot", "there is no file"),
    (("robot", "x" * 5000 + ".urdf"), "robot", "there is no file"),
    (("robot", "a\0.urdf"), "robot", "printable"),
    (("frame", "tipp"), "frame", "no frame 'tipp'"),
    (("spheres", "s.json"), "spheres", "built in"),
    (("locked", {"a": 1.0}), "locked", "built in"),
    (("locked", {"a": math.nan}), "locked.a", "finite"),
    (("locked", []), "locked", "expected an object"),
    (("start", ...), "start", "is missing"),
    (("start", [0, 0]), "start", "expected 3 numbers, got 2"),
    (("start", 0), "start", "expected a list"),
    (("start", 1, math.nan), "start[1]", "finite"),
    (("start", 1, -math.inf), "start[1]", "finite"),
    (("start", 1, True), "start[1]", "expected a number, got True"),
    (("start", 1, "0"), "start[1]", "expected a number, got '0'"),
    (("start", 1, None), "start[1]", "expected a number"),
    (("start", 1, 10**400), "start[1]", "finite"),
    (("start", 1, 10**5000), "start[1]", "finite"),
    (("start", 1, 1e7), "start[1]", "too large"),
    (("start", 1, 3.0), "start[1]", "at 3.0 is outside its limits [-2.9, 2.9]"),
    (("start", [0, 0]), "start", "one for each of "),
    (("start", 1, 45.0), "start[1]", "angles are radians"),
    (("goal", [0.5, 0, 0.4]), "goal[0]", '{"position": [x, y, z]} or {"joints"'),
    (("goal", {"joint": [0, 0, 0]}), "goal.joint", "did you mean 'joints'?"),
    (("goal", {"pos": [0, 0, 0]}), "goal.pos", "known: joints, position"),
    (("goal", 2, "quat_xyzw", [1, 0, 1, 0]), "goal[2].quat_xyzw", "x, y, z, w"),
    (("goal", 2, "quat_xyzw", [1, 0, 1, 0]), "goal[2].quat_xyzw", "by 1.41421"),
    (("goal", ...), "goal", "is missing"),
    (("goal", []), "goal", "at least one"),
    (("goal", None), "goal", "expected an object"),
    (("goal", {}), "goal.position", "is missing"),
    (("goal", {"joints": [0, 0]}), "goal.joints", "expected 3 numbers"),
    (("goal", 0, "joints", [0, 0, -3]), "goal[0].joints[2]", "outside its limits"),
    (("goal", 0, "position", [0, 0, 0]), "goal[0].position", "not a known field"),
    (("goal", 1, "position", [0, 0]), "goal[1].position", "expected 3 numbers"),
    (("goal", 1, "position", 2, math.inf), "goal[1].position[2]", "finite"),
    (("goal", 1, "tolerance", 0), "goal[1].tolerance", "greater than zero"),
    (("goal", 1, "tolerence", 1), "goal[1].tolerence", "did you mean 'tolerance'"),
    (("goal", 1, "angle_tolerance", 1), "goal[1].angle_tolerance", "needs quat_xyzw"),
    (("goal", 1, "quat_xyzw", None), "goal[1].quat_xyzw", "expected a list"),
    (("goal", 2, "quat_xyzw", [0] * 4), "goal[2].quat_xyzw", "unit length"),
    (("goal", 2, "region", {"box": [1, 1]}), "goal[2].region.box", "3 numbers"),
    (("goal", 2, "region", {"box": [1, -1, 1]}), "goal[2].region.box[1]", "negative"),
    (("goal", 2, "region", {"bax": 1}), "goal[2].region.bax", "did you mean 'box'"),
    (("goal", 2, "region", None), "goal[2].region", "expected an object"),
    (("goal", 2, "free_axis", "w"), "goal[2].free_axis", "x, y or z"),
    (("goal", 2, "free_axis", None), "goal[2].free_axis", "expected an axis"),
    (("goal", 1, "free_axis", "z"), "goal[1].free_axis", "needs quat_xyzw"),
    (("obstacles", {}), "obstacles", "expected a list"),
    (("obstacles", 1, 7), "obstacles[1]", "expected an object"),
    (("obstacles", 0, "type", ...), "obstacles[0].type", "is missing"),
    (("obstacles", 0, "type", "bx"), "obstacles[0].type", "did you mean 'box'"),
    (("obstacles", 0, "type", "mesh"), "obstacles[0].size", "not a known field"),
    (("obstacles", 0, "type", "points"), "obstacles[0].size", "not a known field"),
    (("obstacles", 0, "size", ...), "obstacles[0].size", "is missing"),
    (("obstacles", 0, "size", 1, 0), "obstacles[0].size[1]", "greater than zero"),
    (("obstacles", 0, "size", 1, 1e300), "obstacles[0].size[1]", "too large"),
    (("obstacles", 0, "radius", 1), "obstacles[0].radius", "not a known field"),
    (("obstacles", 1, "raduis", 1), "obstacles[1].raduis", "did you mean 'radius'"),
    (("obstacles", 3, "quat_xyzw", [0, 0, 0, 1]), "obstacles[3].quat_xyzw", "known"),
    (("obstacles", 4, "normal", [0, 0, 0]), "obstacles[4].normal", "unit length"),
    (("obstacles", 0, "name", 5), "obstacles[0].name", "expected a text"),
    (("attached", [{"frame": "tip"}]), "attached[0].type", "is missing"),
    (("attached", [{"type": "sphere"}]), "attached[0].frame", "is missing"),
    (("attached", {}), "attached", "expected a list"),
    (("margin", -0.1), "margin", "not be negative"),
    (("margin", False), "margin", "expected a number"),
    (("obstacels", []), "obstacels", "did you mean 'obstacles'"),
    (("name", 1), "name", "expected a text"),
]


IDS = [f"{k}-{field}" for k, (_, field, _) in enumerate(REFUSED)]


@pytest.mark.parametrize(("change", "field", "words"), REFUSED, ids=IDS)
def test_refused_with_the_name_of_the_field(change, field, words):
    with pytest.raises(ProblemError) as caught:
        Problem.from_dict(changed(*change))
    assert caught.value.field == field
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 300


@pytest.mark.parametrize("data", [None, [], "x", 3, [valid()]])
def test_a_document_that_is_no_object_is_refused(data):
    with pytest.raises(ProblemError, match="problem: expected an object"):
        Problem.from_dict(data)


def test_an_empty_list_of_attached_bodies_is_no_request():
    assert Problem.from_dict(changed("attached", [])).margin == 0.01


def test_the_ends_of_the_limits_are_inside():
    robot = one_joint("revolute", -1.0, 2.0)
    goals = (JointGoal([2.0]),)
    assert Problem(robot, [-1.0], goals=goals).start[0] == -1.0
    with pytest.raises(ProblemError) as caught:
        Problem(robot, [np.nextafter(-1.0, -2.0)], goals=goals)
    assert str(caught.value) == (
        "start[0]: joint 'swing' at -1.0000000000000002 is outside its limits"
        " [-1.0, 2.0]"
    )


def test_a_continuous_joint_has_no_limits():
    robot = one_joint("continuous", -np.inf, np.inf)
    problem = Problem(robot, [1000.0], goals=(JointGoal([-1000.0]),))
    assert problem.to_dict()["start"] == [1000.0]


def test_a_robot_without_spheres_is_told_how_to_get_them():
    robot = one_joint("revolute", -1.0, 1.0, spheres=False)
    with pytest.raises(ProblemError, match="`rrnn spheres URDF --out FILE`"):
        Problem(robot, [0.0], goals=(JointGoal([0.0]),))


def test_a_link_without_spheres_is_never_passed_over():
    robot = one_joint("revolute", -1.0, 1.0)
    partly = dataclasses.replace(robot, cover={"missing": ["hand", "finger"]})
    with pytest.raises(ProblemError, match=r"link 'hand' and 1 more; .*`rrnn spheres"):
        Problem(partly, [0.0], goals=(JointGoal([0.0]),))


def test_a_real_urdf_of_meshes_is_told_too():
    # one of its links is a cylinder: nearly the whole arm would go unchecked
    files = importlib.metadata.files("example-robot-data")
    urdf = next(str(f.locate()) for f in files if f.name == "ur5_robot.urdf")
    problem = {"robot": urdf, "start": [0] * 6, "goal": {"joints": [0] * 6}}
    with pytest.raises(ProblemError, match="the mesh of link 'base_link' and"):
        Problem.from_dict({**problem, "frame": "ee_link"})
    with pytest.raises(RobotError, match="nowhere"):
        Problem.from_dict({**problem, "frame": "nowhere"})


def test_built_in_python():
    scene = Scene((Box("b", [1, 1, 1]),))
    goals = [TipGoal([1, 0, 0])]
    problem = Problem(one_joint("revolute", -1, 1), [0], goals=goals, scene=scene)
    assert (problem.frame, problem.robot_ref, problem.margin) == ("tip", "one", 0.0)
    assert isinstance(problem.goals, tuple)
    assert not problem.start.flags.writeable
    assert Problem(problem.robot, [0], goals=goals[0]).goals == (goals[0],)
    with pytest.raises(ProblemError, match="goal: expected a JointGoal or TipGoal"):
        Problem(problem.robot, [0], goals=[{"joints": [0]}])


@pytest.mark.parametrize("name", SCENARIOS)
def test_shipped_scenarios_are_problems_from_every_start(name):
    shipped = scenario(name)
    for start in range(len(shipped.starts)):
        Problem.from_dict(shipped.problem(start))
