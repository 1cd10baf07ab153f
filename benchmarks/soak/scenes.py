"""Problems without end for the soak: shipped, benchmark and random scenes."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path

from rrnn_opt.planning import Problem
from rrnn_opt.robot import Robot
from rrnn_opt.scene.library import SCENARIOS, scenario
from rrnn_opt.validation.studies.arms import arm
from rrnn_opt.validation.studies.clutter import scenes

MBM = Path(__file__).parents[2] / "tests" / "data" / "mbm"
BUILTIN = ("pa10", "panda")
URDF = ("kinova", "xarm7", "baxter, both arms")
Maker = Callable[[int], Problem]


def shipped(name: str) -> Maker:
    """The starts of a scenario in turn."""

    def problem(index: int) -> Problem:
        given = scenario(name)
        return Problem.from_dict(given.problem(index % len(given.starts)))

    return problem


@lru_cache(maxsize=1)
def _benchmark() -> list[str]:
    return [path.read_text("utf-8") for path in sorted(MBM.glob("*.json"))]


def benchmark(index: int) -> Problem:
    """The committed MotionBenchMaker problems in turn."""
    texts = _benchmark()
    return Problem.from_dict(json.loads(texts[index % len(texts)]))


def cluttered(robot: Robot) -> Maker:
    """A new random scene each time, joint goals."""
    return lambda index: next(scenes(robot, 1, index))


def makers(folder: Path) -> dict[str, Maker]:
    """A maker of problems for every kind of scene, by its name.

    Args:
        folder: where fitted spheres of the URDF arms are kept.
    """
    found: dict[str, Maker] = {name: shipped(name) for name in SCENARIOS}
    found["motion bench maker"] = benchmark
    for name in BUILTIN:
        found[f"{name}, clutter"] = cluttered(Robot.builtin(name))
    for name in URDF:
        found[f"{name}, clutter"] = cluttered(arm(name, folder))
    return found
