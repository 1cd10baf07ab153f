"""The rows of a trajectory and the obstacles of a problem, read and refused."""

from __future__ import annotations

from typing import Any

import numpy as np

from rrnn_opt.check import hermite, reading
from rrnn_opt.check.collision import Motion
from rrnn_opt.check.distance import Obstacle, read_obstacle
from rrnn_opt.check.model import Model
from rrnn_opt.check.motion_bound import reach_table
from rrnn_opt.check.reading import Array, get
from rrnn_opt.check.targets import ObstacleTarget, SelfTarget, Target
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
    return Motion(t, q, hermite.pieces(t, q, qd)), qdd


def read_targets(
    model: Model, problem: Any, motion: Motion
) -> tuple[list[Target], float]:
    """All that must keep apart, and the size of the largest number, m.

    Raises:
        DocumentError: an obstacle is malformed or cannot be judged.
    """
    if problem.get("attached"):
        raise DocumentError("problem.attached", "attached bodies cannot be judged yet")
    given = problem.get("obstacles")
    entries = reading.listing([] if given is None else given, "problem.obstacles")
    obstacles = [
        read_obstacle(e, f"problem.obstacles[{k}]") for k, e in enumerate(entries)
    ]
    margin = reading.number(problem.get("margin", 0.0), "problem.margin")
    if margin < 0:
        raise DocumentError("problem.margin", "must not be negative")
    low, high = _extents(model, motion)
    reach = reach_table(model, low, high)
    moving = np.flatnonzero(model.carrier >= 0)
    targets: list[Target] = [
        ObstacleTarget(model, obstacle, moving, reach, margin) for obstacle in obstacles
    ]
    # two bodies that cannot move are nobody's concern
    live = np.any(model.carrier[model.pairs] >= 0, axis=1)
    targets.append(SelfTarget(model, model.pairs[live], reach))
    return targets, _size(model, obstacles, reach, motion)


def _extents(model: Model, motion: Motion) -> tuple[Array, Array]:
    """Least and greatest joint values that occur, (nj,) each."""
    low, high = hermite.position_range(motion.pieces)
    ends = model.joint_values(np.stack([low.min(axis=0), high.max(axis=0)]))
    grow = 1e-9 * (1 + np.abs(ends).max(axis=0))
    return ends.min(axis=0) - grow, ends.max(axis=0) + grow


def _size(
    model: Model, obstacles: list[Obstacle], reach: Array, motion: Motion
) -> float:
    """Largest number that rounding can act on, m."""
    arm = float(reach.max(initial=0.0)) + float(np.abs(model.translation).max())
    turned = 1.0 + float(np.abs(motion.q).max())
    world = max(
        (float(np.abs(o.position).max() + o.dims.sum()) for o in obstacles),
        default=0.0,
    )
    return arm * turned + world
