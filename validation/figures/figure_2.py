"""Figure 2: one heuristic rollout stuck at an obstacle, the random-RNN past it.

    python -m rrnn_opt.validation.figures.figure_2 --out DIR

A planar arm with three joints, drawn from above.  Left: the network (17) with
the sign sets (12), attracted by the target alone.  Right: the repaired planner.
"""

from __future__ import annotations

import argparse
import io
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.planning import PaperRnn, Problem, plan
from rrnn_opt.report.files import write_bytes
from rrnn_opt.report.plan.palette import END, OBSTACLE, START, TARGET, time_colours
from rrnn_opt.robot import Kinematics
from rrnn_opt.validation.ending import ended
from rrnn_opt.validation.figures.rolled import rolled

Array = NDArray[np.float64]
PROBLEM: dict[str, Any] = {
    "robot": "planar3",
    "start": [1.0, -0.3, -0.3],
    "goal": {"position": [1.0, -1.0, 0.0], "tolerance": 0.001},
    "obstacles": [
        {
            "name": "bar",
            "type": "box",
            "size": [1.1, 0.12, 0.4],
            "position": [1.55, 0.0, 0.0],
        },
        {
            "name": "lip",
            "type": "box",
            "size": [0.12, 0.5, 0.4],
            "position": [1.94, 0.25, 0.0],
        },
    ],
}
POSTURES = 14


def outlines(problem: Problem, path: Array) -> Array:
    """Joints and tip of the arm along a path, (N, 4, 2), m."""
    import casadi as ca

    kin = Kinematics(problem.robot)
    points = ca.horzcat(kin.origins(), kin.position())
    place = ca.Function("points", [kin.q], [points])
    return np.array([np.array(place(q)).T[:, :2] for q in path])


def resampled(path: Array, count: int) -> Array:
    """``count`` postures equally spaced along a path, (count, nv)."""
    ways = np.linalg.norm(np.diff(path, axis=0), axis=1)
    along = np.concatenate([[0.0], np.cumsum(ways)])
    wanted = np.linspace(0.0, along[-1], count)
    return np.stack([np.interp(wanted, along, column) for column in path.T], axis=1)


def draw(axes: Any, problem: Problem, path: Array, title: str) -> None:
    """One panel: obstacles, ghosts, first and last posture, way of the tip."""
    from matplotlib.patches import Rectangle

    for box in PROBLEM["obstacles"]:
        corner = np.array(box["position"][:2]) - np.array(box["size"][:2]) / 2
        low = (float(corner[0]), float(corner[1]))
        axes.add_patch(Rectangle(low, *box["size"][:2], color=OBSTACLE, alpha=0.7))
    shapes = outlines(problem, resampled(path, POSTURES))
    for shape, colour in zip(shapes, time_colours(POSTURES), strict=True):
        axes.plot(*shape.T, color=colour, lw=1.2, alpha=0.5)
    for shape, colour in ((shapes[0], START), (shapes[-1], END)):
        axes.plot(*shape.T, "-o", color=colour, lw=3.2, ms=5)
    tips = outlines(problem, resampled(path, 300))[:, -1]
    axes.plot(*tips.T, color="#2b2f38", lw=1.4, ls=(0, (4, 2)))
    goal = PROBLEM["goal"]["position"]
    axes.plot(goal[0], goal[1], "o", ms=11, color=TARGET)
    axes.set_title(title, fontsize=10, loc="left")
    axes.set_aspect("equal")
    axes.set_xlim(-0.4, 2.6)
    axes.set_ylim(-1.7, 1.9)
    axes.set_xlabel("x [m]", fontsize=8)
    axes.set_ylabel("y [m]", fontsize=8)
    axes.tick_params(labelsize=7)


def ways() -> tuple[Problem, Array, Array]:
    """The problem, the stuck rollout and the plan that gets through."""
    problem = Problem.from_dict(PROBLEM)
    stuck = rolled(problem, PaperRnn())
    through = plan(problem, seed=0)
    assert through.path is not None
    return problem, stuck, through.path


def picture() -> bytes:
    """The figure as PNG."""
    from matplotlib.figure import Figure

    problem, stuck, through = ways()
    figure = Figure(figsize=(10, 5.6), dpi=120, facecolor="white", layout="tight")
    left, right = figure.subplots(1, 2)
    draw(left, problem, stuck, "one heuristic rollout of (17) with (12): stuck")
    draw(right, problem, through, "random-RNN, projected: through")
    raw = io.BytesIO()
    figure.savefig(raw, format="png")
    return raw.getvalue()


def write(draw_it: Any, name: str, argv: Sequence[str] | None) -> Path:
    """Write a figure into the folder that the command line names."""
    parser = argparse.ArgumentParser(description=name)
    parser.add_argument("--out", type=Path, default=Path("docs/images"))
    args = parser.parse_args(argv)
    args.out.mkdir(parents=True, exist_ok=True)
    return write_bytes(args.out / f"{name}.png", draw_it())


def main(argv: Sequence[str] | None = None) -> Path:
    """Write ``figure_2.png`` and return its path."""
    return write(picture, "figure_2", argv)


if __name__ == "__main__":
    sys.exit(ended(main))
