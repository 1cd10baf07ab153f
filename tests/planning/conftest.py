"""One compiled runtime a robot, and problems around the arm in a window."""

from __future__ import annotations

import numpy as np
import pytest

import rrnn_opt as rr
from rrnn_opt.networks import MemoryCell
from rrnn_opt.planning.search.library import Runtime, Search
from rrnn_opt.planning.search.request import pack
from rrnn_opt.planning.settings.random_rnn import RandomRnn
from rrnn_opt.scene.library import scenario


@pytest.fixture(scope="session")
def pa10():
    return rr.Robot.builtin("pa10")


@pytest.fixture(scope="session")
def pa10_runtime(pa10):
    return Runtime(pa10, MemoryCell())


@pytest.fixture(scope="session")
def planar_runtime():
    return Runtime(rr.Robot.builtin("planar3"), MemoryCell())


@pytest.fixture(scope="session")
def panda_runtime():
    return Runtime(rr.Robot.builtin("panda"), MemoryCell())


def window(offset=(0.0, 0.0), half=0.15, **more):
    """A wall at x = 0.42 with a square window, its centre moved by ``offset``."""
    y, z = offset[0], 0.5 + offset[1]
    reach = 1.5
    sides = {
        "below": ([0.42, 0.0, (z - half - 1.0) / 2], [0.02, 3.0, z - half + 1.0]),
        "above": ([0.42, 0.0, (z + half + 2.0) / 2], [0.02, 3.0, 2.0 - z - half]),
        "left": ([0.42, (y + half + reach) / 2, z], [0.02, reach - y - half, 2 * half]),
        "right": (
            [0.42, (y - half - reach) / 2, z],
            [0.02, reach + y - half, 2 * half],
        ),
    }
    boxes = [
        {"name": name, "type": "box", "position": position, "size": size}
        for name, (position, size) in sides.items()
    ]
    return {
        "robot": "pa10",
        "start": scenario("window").problem(0)["start"],
        "goal": {"position": [0.7, 0.05, 0.45], "tolerance": 0.001},
        "obstacles": boxes,
        **more,
    }


@pytest.fixture(scope="session")
def window_problem():
    return window


def search_of(runtime, problem, seed=0, settings=None):
    """A search for the problem's own goals, without the feasibility proofs."""
    joints = tuple(g.joints for g in problem.goals if hasattr(g, "joints"))
    tips = tuple(g for g in problem.goals if not hasattr(g, "joints"))
    packed = pack(problem, joints, tips, seed)
    return Search(runtime, settings or RandomRnn(), packed.struct, packed.keep)


@pytest.fixture(scope="session")
def open_search():
    return search_of


@pytest.fixture
def rng():
    return np.random.default_rng(20240917)
