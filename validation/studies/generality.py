"""Arms that nothing was tuned on, in scenes drawn at random.

    python -m rrnn_opt.validation.studies.generality --scenes 200 --out DIR

Four arms of example-robot-data, with spheres fitted by ``rrnn spheres`` (in
DIR, made when missing), each in its own random scenes: ``OBSTACLES`` boxes,
cylinders and spheres within reach, a start and a goal posture drawn until they
are free.  The planner's constants are those of every other scene.  The rule by
which ``rrnn spheres`` leaves neighbouring links unchecked was written after
three trial scenes of the UR10 with seed 0, so the kept table has another seed.
A scene may have no solution; it then counts as not solved.
"""

from __future__ import annotations

import argparse
import json
import platform
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.planning import Problem, plan
from rrnn_opt.planning.feasibility import blocked
from rrnn_opt.planning.request import pack
from rrnn_opt.planning.runtime_cache import runtime_of
from rrnn_opt.planning.runtime_library import Search
from rrnn_opt.planning.settings import RandomRnn
from rrnn_opt.robot import Robot
from rrnn_opt.robot.bound import reach_ball
from rrnn_opt.robot.spheres import fit_spheres
from rrnn_opt.study import wilson

Array = NDArray[np.float64]

OBSTACLES = 12
SIZE = (0.05, 0.25)
"""Least and greatest edge, diameter or length of an obstacle, times the reach."""
KEEP_OUT = 0.25
"""No obstacle has its middle nearer to the first joint, times the reach."""
DRAWS = 400
TIME_LIMIT = 10.0
INFLATION, MOST = 0.03, 8

ARMS = {
    "ur10": ("ur_description/urdf/ur10_robot.urdf", "tool0"),
    "xarm7": ("xarm_description/urdf/xarm7.urdf", None),
    "kinova": ("kinova_description/robots/kinova.urdf", None),
    "baxter": ("baxter_description/urdf/baxter.urdf", "left_gripper"),
}
"""File of example-robot-data, and tip."""


@dataclass(frozen=True)
class Row:
    """One arm's scenes: how many were solved, and the times of those."""

    arm: str
    joints: int
    spheres: int
    scenes: int
    solved: int
    statuses: dict[str, int]
    plan_ms: tuple[float, float]
    total_ms: tuple[float, float]

    def to_dict(self) -> dict[str, Any]:
        """JSON-ready."""
        return {name: getattr(self, name) for name in self.__dataclass_fields__}


def robots_folder() -> Path:
    """Where example-robot-data keeps its robots."""
    files = metadata.files("example-robot-data") or []
    panda = next(file for file in files if file.name == "panda.urdf")
    return Path(str(panda.locate())).resolve().parents[2]


def arm(name: str, out: Path) -> Robot:
    """One of ``ARMS`` with fitted spheres, which are kept in ``out``."""
    file, tip = ARMS[name]
    urdf, spheres = robots_folder() / file, out / f"{name}_spheres.json"
    if not spheres.is_file():
        fitted = fit_spheres(urdf, tip=tip, inflation=INFLATION, most=MOST)
        if not fitted.covered:
            raise RuntimeError(f"the spheres of {name} do not cover it")
        spheres.write_text(json.dumps(fitted.to_dict()), encoding="utf-8")
    return Robot.from_urdf(urdf, tip=tip, spheres=spheres)


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
    from rrnn_opt.planning.goals import goals_from_data
    from rrnn_opt.scene.reading import scene_from_list

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
    runtime = runtime_of(robot_of(problem), settings.cell)
    with Search(runtime, settings, packed.struct, packed.keep) as search:
        free = drawn[search.postures_free(drawn)]
        kept = [q for q in free[:8] if blocked(problem, search, q, "start") is None]
    return (kept[0], kept[1]) if len(kept) > 1 else None


def robot_of(problem: Problem) -> Robot:
    """The robot as the problem holds it."""
    return problem.robot


def run(name: str, out: Path, count: int, seed: int) -> Row:
    """Plan in all scenes of one arm."""
    robot = arm(name, out)
    statuses: dict[str, int] = {}
    plan_s, total_s = [], []
    for index, problem in enumerate(scenes(robot, count, seed)):
        begin = time.perf_counter()
        result = plan(problem, seed=index, time_limit=TIME_LIMIT)
        statuses[result.status] = statuses.get(result.status, 0) + 1
        if result.solved:
            plan_s.append(result.stats.plan_time_s)
            total_s.append(time.perf_counter() - begin)
    solved = statuses.get("solved", 0)
    return Row(
        name,
        robot.nv,
        len(robot.spheres),
        count,
        solved,
        statuses,
        _percentiles(plan_s),
        _percentiles(total_s),
    )


def _percentiles(seconds: list[float]) -> tuple[float, float]:
    if not seconds:
        return float("nan"), float("nan")
    p50, p95 = np.percentile(1e3 * np.array(seconds), [50, 95])
    return float(p50), float(p95)


def page(rows: Sequence[Row], command: str) -> str:
    """The table as a page."""
    lines = [
        "# Arms that nothing was tuned on, in random scenes",
        "",
        f"`{command}`",
        "",
        f"{OBSTACLES} boxes, cylinders and spheres of {SIZE[0]:g} to {SIZE[1]:g} times"
        " the reach at random places",
        "and turns; joint goals; spheres fitted by `rrnn spheres` "
        f"(inflation {INFLATION:g} m, at most {MOST} a mesh).",
        "Solved means found *and* proved; a scene may have no solution.  Times are"
        " of the",
        f"solved ones, p50 / p95, on {platform.machine()}, Python "
        f"{platform.python_version()}.",
        "",
        "| arm | joints | spheres | solved | 95 % interval | search [ms] | all [ms] |"
        " other ends |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        low, high = wilson(row.solved, row.scenes)
        ends = {k: v for k, v in row.statuses.items() if k != "solved"}
        others = ", ".join(f"{v} {k}" for k, v in sorted(ends.items())) or "none"
        times = " | ".join(f"{a:.2f} / {b:.2f}" for a, b in (row.plan_ms, row.total_ms))
        lines.append(
            f"| {row.arm} | {row.joints} | {row.spheres} | {row.solved}/{row.scenes} |"
            f" {low:.3f} to {high:.3f} | {times} | {others} |"
        )
    return "\n".join(lines) + "\n"


def main(argv: Sequence[str] | None = None) -> int:
    """Run the study and write ``generality.json`` and ``generality.md``."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--arms", nargs="+", default=list(ARMS), choices=list(ARMS))
    parser.add_argument("--scenes", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, required=True)
    args = parser.parse_args(argv)
    args.out.mkdir(parents=True, exist_ok=True)
    rows: list[Row] = []
    command = (
        "python -m rrnn_opt.validation.studies.generality"
        f" --scenes {args.scenes} --seed {args.seed} --out DIR"
    )
    for name in args.arms:
        rows.append(run(name, args.out, args.scenes, args.seed))
        print(rows[-1], file=sys.stderr)
        data = json.dumps([row.to_dict() for row in rows], indent=1)
        (args.out / "generality.json").write_text(data, encoding="utf-8")
        (args.out / "generality.md").write_text(page(rows, command), encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
