"""Starts of the scenarios: the shipped ones, then as many as are wanted."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.planning import Problem, RandomRnn
from rrnn_opt.planning.search.request import pack
from rrnn_opt.planning.searches import open_search, runtime_for
from rrnn_opt.robot import Kinematics
from rrnn_opt.scene.library import scenario

Array = NDArray[np.float64]
IN_FRONT = 0.34
"""Largest x of the tip at a start, m; the obstacles begin at 0.41 m."""
BLOCK = 4096


def start_problem(name: str, index: int) -> dict[str, Any]:
    """The scenario from its start ``index``, in the problem file's form.

    The first ones are the scenario's own; the others are drawn.

    Args:
        name: of the scenario.
        index: of the start.
    """
    shipped = len(scenario(name).starts)
    if index < shipped:
        return scenario(name).problem(index)
    drawn = drawn_starts(name, _rounded(index - shipped + 1))[index - shipped]
    return {
        **scenario(name).problem(0),
        "name": f"{name} {index}",
        "start": drawn.tolist(),
    }


def _rounded(count: int) -> int:
    """Few different sizes, so that the cache below is used."""
    return 1 << (count - 1).bit_length()


@lru_cache(maxsize=8)
def drawn_starts(name: str, count: int, seed: int = 0) -> Array:
    """Uniform postures in the limits, free, with the tip in front, (count, nv).

    A longer list begins with the shorter ones.

    Args:
        name: of the scenario.
        count: how many.
        seed: of the draws.
    """
    problem = Problem.from_dict(scenario(name).problem(0))
    settings, limits = RandomRnn(), problem.robot.limits
    position = Kinematics(problem.robot).functions()["position"]
    rng = np.random.default_rng([seed, 34])
    packed = pack(problem, (), (), 0)
    found: list[Array] = []
    with open_search(runtime_for(problem.robot, settings), settings, packed) as search:
        while len(found) < count:
            q = rng.uniform(limits.lower, limits.upper, (BLOCK, problem.robot.nv))
            q = q[search.postures_free(q)]
            tip = np.asarray(position.map(len(q))(q.T))
            found.extend(q[tip[0] < IN_FRONT])
    return np.array(found[:count])
