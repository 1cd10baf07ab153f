"""Figure 4: the three schemes in both scenarios, from the same start.

    python -m rrnn_opt.validation.figures.figure_4 --out DIR

Where a single rollout fails, its way up to there is drawn.
"""

from __future__ import annotations

import io
import sys
from collections.abc import Sequence
from pathlib import Path

from rrnn_opt.planning import PlanResult, Problem, SingleRollout, plan
from rrnn_opt.report.plan.picture import draw_scene
from rrnn_opt.validation.ending import ended
from rrnn_opt.validation.figures.figure_2 import write
from rrnn_opt.validation.figures.rolled import planned_or_rolled
from rrnn_opt.validation.tables.starts import start_problem
from rrnn_opt.validation.tables.trials import SCENARIOS

STARTS = {"plane": 0, "window": 1}
LEVELS = ("velocity", "acceleration")


def results(scenario: str) -> list[PlanResult]:
    """Method 1, method 2 and the repaired planner from the scenario's start."""
    problem = Problem.from_dict(start_problem(scenario, STARTS[scenario]))
    rolled = [
        planned_or_rolled(problem, SingleRollout(level="velocity")),
        planned_or_rolled(problem, SingleRollout(level="acceleration")),
    ]
    return [*rolled, plan(problem)]


def picture() -> bytes:
    """The figure as PNG."""
    from matplotlib.figure import Figure
    from PIL import Image

    figure = Figure(figsize=(13.5, 8.4), dpi=150, facecolor="white")
    names = ("method 1", "method 2", "random-RNN")
    for row, scenario in enumerate(SCENARIOS):
        for column, result in enumerate(results(scenario)):
            place = (0.005 + 0.333 * column, 0.51 - 0.5 * row, 0.325, 0.455)
            axes = figure.add_axes(place)
            draw_scene(axes, result.to_dict())
            said = "reached, proved" if result.solved else "stopped on the way"
            title = f"{names[column]}, scenario {row + 1}: {said}"
            figure.text(place[0] + 0.01, place[1] + 0.462, title, fontsize=11)
    raw, small = io.BytesIO(), io.BytesIO()
    figure.savefig(raw, format="png")
    image = Image.open(raw).convert("RGB").reduce(2)
    image.quantize(128).save(small, format="png", optimize=True)
    return small.getvalue()


def main(argv: Sequence[str] | None = None) -> Path:
    """Write ``figure_4.png`` and return its path."""
    return write(picture, "figure_4", argv)


if __name__ == "__main__":
    sys.exit(ended(main))
