"""What robots, scenes, motions and plans are made by, with arguments that are right."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

Call = tuple[Callable[..., Any], Mapping[str, Any]]


POSE = {"position": [0.0, 0.0, 0.0], "quat_xyzw": [0.0, 0.0, 0.0, 1.0]}


@functools.cache
def robot_calls() -> dict[str, Call]:
    """Robots, scenes and problems."""
    return _shapes() | _problems() | _robots()


def _shapes() -> dict[str, Call]:
    from rrnn_opt import scene

    return {
        "Box": (scene.Box, {"name": "b", "size": [1.0, 1.0, 1.0], **POSE}),
        "Cylinder": (scene.Cylinder, {"name": "c", "radius": 1.0, "length": 1, **POSE}),
        "Capsule": (scene.Capsule, {"name": "c", "radius": 1.0, "length": 1, **POSE}),
        "Sphere": (scene.Sphere, {"name": "s", "radius": 1.0, "position": [0, 0, 1]}),
        "HalfSpace": (
            scene.HalfSpace,
            {"name": "h", "normal": [0, 0, 1], "offset": 0.0},
        ),
        "Mesh": (scene.Mesh, {"name": "m", "path": "none.stl", "scale": 1.0}),
        "Points": (scene.Points, {"name": "p", "path": "none.npy", "radius": 1.0}),
    }


def _problems() -> dict[str, Call]:
    import rrnn_opt as rr
    from rrnn_opt import planning, scene
    from rrnn_opt.planning.problem.attached import Attached

    box = scene.Box("b", [1.0, 1.0, 1.0], [3.0, 0.0, 0.0])
    goal = {"tolerance": 0.01, "angle_tolerance": 0.1, "free_axis": "z"}
    return {
        "Scene": (scene.Scene, {"obstacles": (box,)}),
        "JointGoal": (planning.JointGoal, {"joints": [0.1, 0.2, 0.3]}),
        "TipGoal": (planning.TipGoal, goal | POSE | {"region": [0.1, 0.1, 0.1]}),
        "Attached": (Attached, {"frame": "tip", "shape": box}),
        "Problem": (
            planning.Problem,
            {
                "robot": rr.Robot.builtin("planar3"),
                "start": np.zeros(3),
                "goals": (planning.JointGoal([0.1, 0.2, 0.3]),),
                "scene": scene.Scene((box,)),
                "margin": 0.0,
                "frame": "tip",
                "locked": {},
                "attached": (),
                "name": "n",
            },
        ),
        "Problem.from_dict": (rr.Problem.from_dict, {"data": {}}),
        "Problem.load": (rr.Problem.load, {"path": "none.json"}),
    }


def _robots() -> dict[str, Call]:
    from rrnn_opt import robot
    from rrnn_opt.robot import Robot

    arm = Robot.builtin("planar3")
    return {
        "robot.Limits": (robot.Limits, fields_of(arm.limits)),
        "robot.JointTree": (robot.JointTree, fields_of(arm.tree)),
        "robot.Frame": (robot.Frame, fields_of(arm.frames[-1])),
        "robot.Sphere": (robot.Sphere, fields_of(arm.spheres[0])),
        "robot.Robot": (robot.Robot, fields_of(arm)),
        "Robot.builtin": (Robot.builtin, {"name": "planar3"}),
        "Robot.from_urdf": (Robot.from_urdf, {"path": "none.urdf", "tip": "t"}),
        "Robot.from_dict": (Robot.from_dict, {"data": arm.to_dict()}),
    }


def fields_of(value: Any) -> dict[str, Any]:
    """What a dataclass was made with, by name."""
    return {f.name: getattr(value, f.name) for f in dataclasses.fields(value) if f.init}


@functools.cache
def motion_calls() -> dict[str, Call]:
    """Paths, timing, simulation, settings of planners."""
    return _paths() | _loops() | _plans()


def _paths() -> dict[str, Call]:
    from rrnn_opt import motion
    from rrnn_opt.robot import Robot

    limits = Robot.builtin("planar3").limits
    way = [[0.0, 0.0, 0.0], [0.1, 0.2, 0.3]]
    rows = {"t": [0.0, 1.0], "q": way, "qd": [[0.0] * 3] * 2}
    return {
        "Path": (motion.Path, {"waypoints": way}),
        "Trajectory": (motion.Trajectory, {**rows, "qdd": [[0.0] * 3] * 2}),
        "Trajectory.from_rows": (motion.Trajectory.from_rows, rows),
        "RetimeSettings": (motion.RetimeSettings, fields_of(motion.RetimeSettings())),
        "retime": (
            motion.retime,
            {"waypoints": way, "limits": limits, "spacing": 0.1},
        ),
        "stop_and_go": (motion.stop_and_go, {"waypoints": way, "limits": limits}),
        "shortcut": (
            motion.shortcut,
            {
                "waypoints": way,
                "segment_is_free": lambda a, b: True,
                "rng": np.random.default_rng(0),
                "attempts": 5,
            },
        ),
    }


def _loops() -> dict[str, Call]:
    from rrnn_opt import simulation
    from rrnn_opt.robot import Robot

    curve = simulation.Curve("point", 1.0, 0.1, offset=np.zeros(3))
    task, arm = simulation.Task(curve, np.full(3, 0.3)), Robot.builtin("planar3")
    return {
        "Curve": (simulation.Curve, fields_of(curve)),
        "Control": (simulation.Control, fields_of(simulation.Control())),
        "Noise": (simulation.Noise, fields_of(simulation.Noise())),
        "Task": (simulation.Task, fields_of(task)),
        "Task.from_dict": (simulation.Task.from_dict, {"data": {}}),
        "simulate": (
            simulation.simulate,
            {"scheme": "minimum_velocity", "robot": arm, "task": task},
        ),
    }


def _plans() -> dict[str, Call]:
    from rrnn_opt import planning
    from rrnn_opt.robot import Robot

    goals = (planning.JointGoal([0.1, 0.2, 0.3]),)
    problem = planning.Problem(Robot.builtin("planar3"), np.zeros(3), goals=goals)
    return {
        "RandomRnn": (planning.RandomRnn, fields_of(planning.RandomRnn())),
        "PaperRnn": (planning.PaperRnn, fields_of(planning.PaperRnn())),
        "SingleRollout": (planning.SingleRollout, fields_of(planning.SingleRollout())),
        "plan": (
            planning.plan,
            {
                "problem": problem,
                "seed": 0,
                "planner": "random-rnn",
                "settings": None,
                "time_limit": 0.2,
                "max_explorations": 5,
                "improve_s": 0.0,
            },
        ),
        "plan_many": (
            lambda **given: list(planning.plan_many(**given)),
            {"problems": [problem], "seeds": [0], "jobs": 1, "max_explorations": 5},
        ),
    }
