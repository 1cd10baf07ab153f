"""Random cluttered scenes with a free start and a free goal posture."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.planning import Problem
from rrnn_opt.planning.problem.goals import goals_from_data
from rrnn_opt.planning.search.cache import runtime_of
from rrnn_opt.planning.search.feasibility import blocked
from rrnn_opt.planning.search.library import Search
from rrnn_opt.planning.search.request import pack
from rrnn_opt.planning.settings.random_rnn import RandomRnn
from rrnn_opt.robot import Robot
from rrnn_opt.robot.reach import reach_ball
from rrnn_opt.scene.reading import scene_from_list

Array = NDArray[np.float64]

OBSTACLES = 12
SIZE = (0.05, 0.25)
"""Least and greatest edge, diameter or length of an obstacle, times the reach."""
KEEP_OUT = 0.25
"""No obstacle has its middle nearer to the first joint, times the reach."""
DRAWS = 400


def scenes(robot: Robot, count: int, seed: int) -> Iterator[Problem]:
    """Random cluttered scenes with a free start and a free goal posture."""
    rng = np.random.default_rng([seed, robot.nv, len(robot.spheres)])
    made = 0
    while made < count:
        obstacles = clutter(robot, rng)
        ends = _free_postures(robot, obstacles, rng)
        if ends is not None:
            made += 1
            goal = {"joints": ends[1].tolist()}
            yield _problem(robot, ends[0], goal, obstacles)


def clutter(robot: Robot, rng: np.random.Generator) -> list[dict[str, Any]]:
    """``OBSTACLES`` obstacles around the first joint."""
    centre, reach = reach_ball(robot)
    found: list[dict[str, Any]] = []
    while len(found) < OBSTACLES:
        offset = rng.uniform(-1.0, 1.0, 3)
        if not KEEP_OUT < np.linalg.norm(offset) < 1.0:
            continue
        turn = rng.normal(size=4)
        a, b, c = reach * rng.uniform(*SIZE, 3)
        shape: dict[str, Any] = [
            {"type": "box", "size": [a, b, c]},
            {"type": "cylinder", "radius": a / 2, "length": b},
            {"type": "sphere", "radius": a / 2},
        ][int(rng.integers(3))]
        if shape["type"] != "sphere":
            shape["quat_xyzw"] = (turn / np.linalg.norm(turn)).tolist()
        place = (centre + reach * offset).tolist()
        found.append({"name": f"o{len(found)}", "position": place, **shape})
    return found


def _problem(
    robot: Robot, start: Array, goal: dict[str, Any], obstacles: list[dict[str, Any]]
) -> Problem:
    scene = scene_from_list(obstacles)
    return Problem(robot, start, goals=goals_from_data(goal), scene=scene)


def _free_postures(
    robot: Robot, obstacles: list[dict[str, Any]], rng: np.random.Generator
) -> tuple[Array, Array] | None:
    """Two free postures, or None when too few draws are free."""
    low = np.where(np.isfinite(robot.limits.lower), robot.limits.lower, -np.pi)
    high = np.where(np.isfinite(robot.limits.upper), robot.limits.upper, np.pi)
    drawn = rng.uniform(low, high, (DRAWS, robot.nv))
    goal = {"joints": drawn[0].tolist()}
    problem = _problem(robot, drawn[0], goal, obstacles)
    settings = RandomRnn()
    packed = pack(problem, (), (), 0)
    runtime = runtime_of(problem.robot, settings.cell)
    with Search(runtime, settings, packed.struct, packed.keep) as search:
        free = drawn[search.postures_free(drawn)]
        kept = [q for q in free[:8] if blocked(problem, search, q, "start") is None]
    return (kept[0], kept[1]) if len(kept) > 1 else None
