"""The rows of a trajectory and the obstacles of a problem, read and refused."""

from __future__ import annotations

from typing import Any

import numpy as np

from rrnn_opt.check.plans import reading
from rrnn_opt.check.plans.collision.parts import Parts
from rrnn_opt.check.plans.collision.scene import Scene, build_scene
from rrnn_opt.check.plans.motion import Motion
from rrnn_opt.check.plans.reading import Array, get
from rrnn_opt.check.plans.robot.model import Model
from rrnn_opt.check.plans.solids.obstacle import read_obstacle
from rrnn_opt.errors import DocumentError


def read_motion(trajectory: Any, nv: int) -> tuple[Motion, Array | None]:
    """The rows of a trajectory, and its "qdd" if it has one.

    Raises:
        DocumentError: shapes differ, or times do not increase from zero.
    """
    block = reading.mapping(trajectory, "trajectory")
    t = reading.numbers(get(block, "t", "trajectory"), (None,), "trajectory.t")
    n = len(t)
    if n < 2:
        raise DocumentError("trajectory.t", "must have two rows at least")
    if t[0] != 0.0 or np.any(np.diff(t) < 1e-9):
        raise DocumentError("trajectory.t", "must increase strictly from zero")
    q = reading.numbers(get(block, "q", "trajectory"), (n, nv), "trajectory.q")
    qd = reading.numbers(get(block, "qd", "trajectory"), (n, nv), "trajectory.qd")
    qdd = block.get("qdd")
    if qdd is not None:
        qdd = reading.numbers(qdd, (n, nv), "trajectory.qdd")
    return Motion.of(t, q, qd), qdd


def read_scene(parts: Parts, problem: Any, motion: Motion) -> Scene:
    """All that must keep apart.

    Raises:
        DocumentError: an obstacle is malformed or cannot be judged.
    """
    _require_attached(parts.bodies.model, problem.get("attached"))
    given = problem.get("obstacles")
    entries = reading.listing([] if given is None else given, "problem.obstacles")
    obstacles = [
        read_obstacle(e, f"problem.obstacles[{k}]") for k, e in enumerate(entries)
    ]
    margin = reading.number(problem.get("margin", 0.0), "problem.margin")
    if margin < 0:
        raise DocumentError("problem.margin", "must not be negative")
    return build_scene(parts, obstacles, margin, motion)


def _require_attached(model: Model, attached: Any) -> None:
    """Every attached object must be among the bodies of the robot block.

    What its spheres must cover is stated in the axes of a frame that the robot
    block does not have; that they do is the word of whoever wrote the block.
    """
    entries = reading.listing([] if attached is None else attached, "problem.attached")
    for k, entry in enumerate(entries):
        field = f"problem.attached[{k}]"
        name = get(reading.mapping(entry, field), "name", field)
        if name not in model.links:
            raise DocumentError(f"{field}.name", "no sphere of the robot stands for it")
