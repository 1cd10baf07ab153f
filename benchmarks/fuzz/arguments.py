"""Python constructors and functions: one or two arguments are not as documented."""

from __future__ import annotations

import dataclasses
import functools
import math
import random
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.fuzz import mutation
from benchmarks.fuzz.judging import ACCEPTED, Entry, require

MAY_BE_INFINITE = ("longest_step", "patience_s", "primal", "dual", "gap")
MAY_BE_INFINITE += ("complementarity",)
"""Residuals are infinite where the answer is no answer."""
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
        "robot.Limits": (robot.Limits, _fields(limits)),
        "robot.JointTree": (robot.JointTree, _fields(tree)),
        "robot.Frame": (robot.Frame, _fields(frame)),
        "robot.Sphere": (robot.Sphere, _fields(arm.spheres[0])),
        "robot.Robot": (robot.Robot, _fields(arm)),
        "Robot.builtin": (rr.Robot.builtin, {"name": "planar3"}),
        "Robot.from_urdf": (rr.Robot.from_urdf, {"path": "none.urdf", "tip": "t"}),
        "Problem.from_dict": (rr.Problem.from_dict, {"data": {}}),
        "Problem.load": (rr.Problem.load, {"path": "none.json"}),
    }


def _fields(value: Any) -> dict[str, Any]:
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
        "RetimeSettings": (motion.RetimeSettings, _fields(motion.RetimeSettings())),
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
        "RandomRnn": (planning.RandomRnn, _fields(planning.RandomRnn())),
        "PaperRnn": (planning.PaperRnn, _fields(planning.PaperRnn())),
        "SingleRollout": (planning.SingleRollout, _fields(planning.SingleRollout())),
        "Curve": (simulation.Curve, _fields(curve)),
        "Control": (simulation.Control, _fields(simulation.Control())),
        "Noise": (simulation.Noise, _fields(simulation.Noise())),
        "Task": (simulation.Task, _fields(task)),
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


@functools.cache
def symbolic_calls() -> dict[str, Call]:
    """Symbols, sets, schemes, networks, solving, claims."""
    import casadi as ca
    import qpsolvers

    import rrnn_opt as rr
    from rrnn_opt import formulations, networks, solving, symbolic
    from rrnn_opt.claim import Claim, Range, Relation

    kin = rr.Kinematics(rr.Robot.builtin("planar3"))
    form = formulations.minimum_velocity(kin)
    x = ca.SX.sym("x", 3)
    symbol = symbolic.Symbol("x", x)
    point = {"q": [0.3, 0.5, 0.7], "rd_dot": [0.01, 0.0, 0.0]}
    qp = qpsolvers.Problem(np.eye(2), np.ones(2), lb=-np.ones(2), ub=np.ones(2))
    rules = (networks.E47, networks.DualNetwork, networks.FiniteTimeZnn)
    rules += (networks.Hildreth, networks.Lvi94, networks.LviPdnn, networks.PrimalDual)
    rules += (networks.NoiseTolerantZnn, networks.SimplifiedLviPdnn, networks.Znn)
    rules += (networks.VaryingGainZnn, networks.MemoryCell)
    schemes = {
        name: (getattr(formulations, name), {"kin": kin, **_scheme(name)})
        for name in formulations.__all__
        if name != "slide"
    }
    return {
        **{rule.__name__: (rule, _fields(rule())) for rule in rules},
        **schemes,
        "Symbol": (symbolic.Symbol, {"name": "x", "sx": x, "unit": "m"}),
        "sets.Box": (symbolic.Box, {"lower": np.zeros(3), "upper": np.ones(3)}),
        "sets.Ball": (symbolic.Ball, {"center": np.zeros(3), "radius": 1.0}),
        "sets.Orthant": (symbolic.Orthant, {"dimension": 3}),
        "sets.Product": (symbolic.Product, {"factors": (symbolic.Orthant(2),)}),
        "Box.project": (
            symbolic.Box(np.zeros(3), np.ones(3)).project,
            {"x": [1, 2, 3]},
        ),
        "Euler": (rr.Euler, {"h": 0.01}),
        "qp.at": (form.qp.at, point),
        "settle": (
            rr.settle,
            {"dyn": networks.PrimalDual()(form), "tolerance": 1e-6, "max_steps": 100}
            | {"step": None, "start": None, "newton": True, **point},
        ),
        "Tolerances": (solving.Tolerances, _fields(solving.Tolerances())),
        "kkt_residual": (
            solving.kkt_residual,
            {"problem": qp, "x": np.zeros(2), "duals": None},
        ),
        "judge": (
            solving.judge,
            {"problem": qp, "x": np.zeros(2), "duals": None, "tolerance": 1e-6},
        ),
        "Qpsolvers": (solving.Qpsolvers, {"name": "daqp", "tolerance": 1e-6}),
        "OsqpSession": (solving.OsqpSession, {"mode": "warm", "tolerance": 1e-6}),
        "DaqpSession": (solving.DaqpSession, {"mode": "warm", "tolerance": 1e-6}),
        "ActiveSet": (solving.ActiveSet, {"mode": "cold", "tolerance": 1e-6}),
        "Relation": (Relation, {"expression": x, "sense": ">=0"}),
        "Range": (Range, {"variable": "x", "lower": (None,), "upper": (None,)}),
        "Claim": (
            Claim,
            {
                "id": "C",
                "source": "s",
                "statement": "t",
                "variables": (symbol,),
                "goal": Relation(x, ">=0"),
                "order": None,
                "jacobian": None,
            },
        ),
        "kin.position": (kin.position, {"frame": "tip"}),
        "kin.jacobian": (kin.jacobian, {"frame": "tip"}),
        "compile": (rr.emit.compile, {"functions": [], "name": "f", "real": "double"}),
    }


def _scheme(name: str) -> dict[str, Any]:
    import inspect

    from rrnn_opt import formulations

    wanted = inspect.signature(getattr(formulations, name)).parameters
    return {k: p.default for k, p in wanted.items() if k != "kin"}


@functools.cache
def other_calls() -> dict[str, Call]:
    """Studies, verification, packages, checks."""
    import rrnn_opt as rr
    from rrnn_opt import check, study, verification
    from rrnn_opt.embedding.options import Options

    arm = rr.Robot.builtin("planar3")
    kin = rr.Kinematics(arm)
    form = rr.formulations.minimum_velocity(kin)
    dynamics = rr.networks.PrimalDual()(form)
    region = {"centre": (0.0, 0.5, 1.0), "half_widths": (0.1, 0.1, 0.1)}
    return {
        "wilson": (study.wilson, {"successes": 3, "n": 10, "confidence": 0.95}),
        "Processes": (study.Processes, {"jobs": 1, "attempts": 2, "patience_s": 1.0}),
        "Cluster": (study.Cluster, {"address": "tcp://127.0.0.1:1", "ahead": 3}),
        "local": (study.local, {"jobs": 1}),
        "generator": (study.generator, {"case": study.Case("k"), "seed": 0}),
        "Region": (verification.Region, region),
        "certify_region": (
            verification.certify_region,
            {
                "arm": arm,
                "region": verification.Region(**region),
                "epsilon": 0.05,
                "error": 0.1,
                "gain": 0.5,
                "floor": 0.02,
                "joints": (1, 2),
                "grid": (1, 1),
                "budget_s": 0.2,
                "jobs": 1,
            },
        ),
        "Options": (Options, _fields(Options())),
        "generate": (
            rr.generate,
            {"dynamics": dynamics, "prefix": "arm", "real": "float", "steps": 1}
            | {"step_size": 0.001, "tolerance": 0.01, "target": "host", "layout": ()},
        ),
        "check_plan": (check.check_plan, {"document": {}}),
        "certify_trajectory": (
            check.certify_trajectory,
            {"robot": arm.to_dict(), "problem": {}, "trajectory": {}},
        ),
    }


GROUPS = {
    "robots and scenes in Python": (robot_calls, 5),
    "motion and planning in Python": (motion_calls, 4),
    "schemes, networks and solvers in Python": (symbolic_calls, 5),
    "studies, proofs and packages in Python": (other_calls, 2),
}


Maker = Callable[[random.Random], Any]


def attempt(
    calls: Callable[[], dict[str, Call]],
    rng: random.Random,
    _: Path,
    make: Maker = mutation.argument,
) -> str:
    """One call with one or two arguments replaced."""
    known = calls()
    name = rng.choice(sorted(known))
    function, given = known[name]
    changed = dict(given)
    for key in rng.sample(sorted(given), min(len(given), rng.choice((1, 1, 1, 2)))):
        changed[key] = make(rng)
    if rng.random() < 0.05:
        changed.pop(rng.choice(sorted(changed)))
    try:
        made = function(**changed)
    except TypeError as error:
        if "argument" in str(error) and str(error).split("(")[0] in _own_names(
            function
        ):
            return "refused"  # Python's own word on a missing argument
        raise
    _true(name, made)
    return ACCEPTED


def _own_names(function: Any) -> tuple[str, ...]:
    name = getattr(function, "__qualname__", "")
    return (name, f"{name}.__init__", name.split(".")[-1])


def _true(name: str, made: Any) -> None:
    """What was made must hold finite numbers where it holds numbers."""
    if not dataclasses.is_dataclass(made) or isinstance(made, type):
        return
    for field in dataclasses.fields(made):
        value = getattr(made, field.name)
        number = isinstance(value, float) and not isinstance(value, bool)
        where = f"{name}.{field.name}"
        if number and field.name not in MAY_BE_INFINITE:
            require(math.isfinite(value), f"{where} is {value}")
        if isinstance(value, np.ndarray) and field.name not in ("lower", "upper"):
            require(value.dtype != object, f"{where} holds objects")
            if value.dtype.kind == "f":
                require(np.all(np.isfinite(value)), f"{where} is not finite")


ENTRIES = tuple(
    Entry(name, functools.partial(attempt, calls), share)
    for name, (calls, share) in GROUPS.items()
)
