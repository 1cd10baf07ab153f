"""What robots, scenes, motions and plans are made by, with arguments that are right."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

Call = tuple[Callable[..., Any], Mapping[str, Any]]


@functools.cache
def robot_calls() -> dict[str, Call]:
    """Robots, scenes and problems."""
    import rrnn_opt as rr
    from rrnn_opt import planning, robot, scene
    from rrnn_opt.planning.problem.attached import Attached

    arm = rr.Robot.builtin("planar3")
    pose = {"position": [0.0, 0.0, 0.0], "quat_xyzw": [0.0, 0.0, 0.0, 1.0]}
    box = scene.Box("b", [1.0, 1.0, 1.0], [3.0, 0.0, 0.0])
    tree, limits, frame = arm.tree, arm.limits, arm.frames[-1]
    return {
        "Box": (scene.Box, {"name": "b", "size": [1.0, 1.0, 1.0], **pose}),
        "Cylinder": (scene.Cylinder, {"name": "c", "radius": 1.0, "length": 1, **pose}),
        "Capsule": (scene.Capsule, {"name": "c", "radius": 1.0, "length": 1, **pose}),
        "Sphere": (scene.Sphere, {"name": "s", "radius": 1.0, "position": [0, 0, 1]}),
        "HalfSpace": (
            scene.HalfSpace,
            {"name": "h", "normal": [0, 0, 1], "offset": 0.0},
        ),
        "Mesh": (scene.Mesh, {"name": "m", "path": "none.stl", "scale": 1.0}),
        "Points": (scene.Points, {"name": "p", "path": "none.npy", "radius": 1.0}),
        "Scene": (scene.Scene, {"obstacles": (box,)}),
        "JointGoal": (planning.JointGoal, {"joints": [0.1, 0.2, 0.3]}),
        "TipGoal": (
            planning.TipGoal,
            {"tolerance": 0.01, "angle_tolerance": 0.1, "free_axis": "z", **pose}
            | {"region": [0.1, 0.1, 0.1]},
        ),
        "Attached": (Attached, {"frame": "tip", "shape": box}),
        "Problem": (
            planning.Problem,
            {
                "robot": arm,
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
        "robot.Limits": (robot.Limits, fields_of(limits)),
        "robot.JointTree": (robot.JointTree, fields_of(tree)),
        "robot.Frame": (robot.Frame, fields_of(frame)),
        "robot.Sphere": (robot.Sphere, fields_of(arm.spheres[0])),
        "robot.Robot": (robot.Robot, fields_of(arm)),
        "Robot.builtin": (rr.Robot.builtin, {"name": "planar3"}),
        "Robot.from_urdf": (rr.Robot.from_urdf, {"path": "none.urdf", "tip": "t"}),
        "Problem.from_dict": (rr.Problem.from_dict, {"data": {}}),
        "Problem.load": (rr.Problem.load, {"path": "none.json"}),
    }


def fields_of(value: Any) -> dict[str, Any]:
    """What a dataclass was made with, by name."""
    return {f.name: getattr(value, f.name) for f in dataclasses.fields(value) if f.init}


@functools.cache
def motion_calls() -> dict[str, Call]:
    """Paths, timing, simulation, settings of planners."""
    import rrnn_opt as rr
    from rrnn_opt import motion, planning, simulation

    arm = rr.Robot.builtin("planar3")
    way = [[0.0, 0.0, 0.0], [0.1, 0.2, 0.3]]
    rows = {"t": [0.0, 1.0], "q": way, "qd": [[0.0] * 3] * 2}
    curve = simulation.Curve("point", 1.0, 0.1, offset=np.zeros(3))
    problem = planning.Problem(
        arm, np.zeros(3), goals=(planning.JointGoal([0.1, 0.2, 0.3]),)
    )
    task = simulation.Task(curve, np.full(3, 0.3))
    return {
        "Path": (motion.Path, {"waypoints": way}),
        "Trajectory": (motion.Trajectory, {**rows, "qdd": [[0.0] * 3] * 2}),
        "Trajectory.from_rows": (motion.Trajectory.from_rows, rows),
        "RetimeSettings": (motion.RetimeSettings, fields_of(motion.RetimeSettings())),
        "retime": (
            motion.retime,
            {"waypoints": way, "limits": arm.limits, "spacing": 0.1},
        ),
        "stop_and_go": (motion.stop_and_go, {"waypoints": way, "limits": arm.limits}),
        "shortcut": (
            motion.shortcut,
            {
                "waypoints": way,
                "segment_is_free": lambda a, b: True,
                "rng": np.random.default_rng(0),
                "attempts": 5,
            },
        ),
        "RandomRnn": (planning.RandomRnn, fields_of(planning.RandomRnn())),
        "PaperRnn": (planning.PaperRnn, fields_of(planning.PaperRnn())),
        "SingleRollout": (planning.SingleRollout, fields_of(planning.SingleRollout())),
        "Curve": (simulation.Curve, fields_of(curve)),
        "Control": (simulation.Control, fields_of(simulation.Control())),
        "Noise": (simulation.Noise, fields_of(simulation.Noise())),
        "Task": (simulation.Task, fields_of(task)),
        "simulate": (
            simulation.simulate,
            {"scheme": "minimum_velocity", "robot": arm, "task": task},
        ),
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
