"""A problem as the arrays that the runtime reads."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.planning.problem.goals import AXES, TipGoal
from rrnn_opt.planning.problem.problem import Problem
from rrnn_opt.planning.search.structs import Request, TipTarget

Array = NDArray[np.float64]


@dataclass(frozen=True)
class PackedRequest:
    """``request_t`` and the arrays that it points into."""

    struct: Request
    keep: tuple[Any, ...]


def sampling_box(problem: Problem) -> tuple[Array, Array]:
    """Box of the random postures: the limits; a turn around the start without."""
    limits, start = problem.robot.limits, problem.start
    lower = np.where(np.isfinite(limits.lower), limits.lower, start - np.pi)
    upper = np.where(np.isfinite(limits.upper), limits.upper, start + np.pi)
    return lower, upper


def tip_target(goal: TipGoal) -> TipTarget:
    """``tip_goal_t`` of a goal; an angle tolerance becomes its chord."""
    target = TipTarget(tolerance=goal.tolerance)
    target.position[:] = list(goal.position)
    target.rotation[:] = list(goal.rotation.ravel(order="F"))
    target.half[:] = list(goal.half_edges)
    if goal.free_axis is not None:
        target.free[AXES.index(goal.free_axis)] = 1.0
    if goal.quat_xyzw is not None:
        target.chord = 2.0 * np.sin(min(goal.angle_tolerance, np.pi) / 2.0)
        target.has_rotation = 1
    return target


def _seed(seed: int, number: int) -> NDArray[np.uint64]:
    """128 bits of the caller's seed for its search ``number``."""
    words = np.random.SeedSequence([seed, number] if number else seed).generate_state(
        2, np.uint64
    )
    return words.astype(np.uint64)


def pack(
    problem: Problem,
    joints: tuple[Array, ...],
    tips: tuple[TipGoal, ...],
    seed: int,
    number: int = 0,
) -> PackedRequest:
    """The request of a search.

    Args:
        problem: robot, scene, start and margin.
        joints: joint goals, (nv,) each.
        tips: goals of the end effector.
        seed: of the runtime's generator.
        number: of the search with this seed; each draws its own stream.
    """
    tree = problem.solids
    arrays = _arrays(problem, joints)
    targets = (TipTarget * max(len(tips), 1))(*(tip_target(t) for t in tips))
    struct = Request(
        **{name: array.ctypes.data for name, array in arrays.items()},
        margin=problem.margin,
        obstacle_count=len(tree.solids.kind),
        flat=tree.flat,
        nodes=len(tree.size),
        leaf=tree.leaf,
        joint_goal_count=len(joints),
        tip_goal_count=len(tips),
    )
    struct.tip_goals = ctypes.addressof(targets)
    struct.seed[:] = [int(word) for word in _seed(seed, number)]
    return PackedRequest(struct, (arrays, targets))


def _arrays(problem: Problem, joints: tuple[Array, ...]) -> dict[str, NDArray[Any]]:
    """What the request points into, by the name of its field."""
    robot, tree = problem.robot, problem.solids
    floats = {
        "lower": robot.limits.lower,
        "upper": robot.limits.upper,
        "sample_lower": sampling_box(problem)[0],
        "sample_upper": sampling_box(problem)[1],
        "start": problem.start,
        "shape": tree.solids.rows,
        "node_bounds": tree.bounds,
        "joint_goals": np.concatenate(joints or (np.zeros(1),)),
    }
    indices = {
        "kind": tree.solids.kind,
        "first": tree.solids.first,
        "node_first": tree.first,
        "node_size": tree.size,
    }
    real = {k: np.ascontiguousarray(v, dtype=np.float64) for k, v in floats.items()}
    whole = {k: np.ascontiguousarray(v, dtype=np.int32) for k, v in indices.items()}
    return {**real, **whole}
