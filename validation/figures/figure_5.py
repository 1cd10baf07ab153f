"""Figure 5: activity of the memory cell before each exploration.

    python -m rrnn_opt.validation.figures.figure_5 --out DIR

Top: the repaired planner over the shipped starts, the longest search in full
colour.  Bottom: Algorithm 1 as printed, with every failure fed to the cell.
"""

from __future__ import annotations

import io
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rrnn_opt.planning import PaperRnn, Problem, RandomRnn
from rrnn_opt.planning.search.request import pack
from rrnn_opt.planning.searches import open_search, runtime_for
from rrnn_opt.planning.settings.planners import PlannerSettings
from rrnn_opt.report.axes import CURVES, dress
from rrnn_opt.validation.ending import ended
from rrnn_opt.validation.figures.figure_2 import write
from rrnn_opt.validation.tables.starts import start_problem
from rrnn_opt.validation.tables.trials import SCENARIOS

Array = NDArray[np.float64]
STARTS = 50
RANDOM_REST, FAILING = 1 - 0.9 / 0.95, 0.6413
"""Where the cell (14) rests under I = 0, 1 - A/w, and under I = 1."""


def activities(
    scenario: str, settings: PlannerSettings, count: int, budget: int
) -> list[Array]:
    """Activity before each exploration of the searches from ``count`` starts."""
    found = []
    for i in range(count):
        problem = Problem.from_dict(start_problem(scenario, i))
        packed = pack(problem, (), tuple(problem.goals), i)  # type: ignore[arg-type]
        runtime = runtime_for(problem.robot, settings)
        with open_search(runtime, settings, packed) as search:
            search.run(budget, 3600.0)
            found.append(search.activity())
    return found


def panel(axes: Any, curves: list[Array], title: str) -> None:
    """All searches pale, the longest dark, with the cell's two levels."""
    longest = max(curves, key=len)
    for curve in curves:
        axes.plot(np.arange(1, len(curve) + 1), curve, color="#b9c3d6", lw=0.8)
    axes.plot(np.arange(1, len(longest) + 1), longest, color=CURVES[3], lw=1.5)
    for level in (RANDOM_REST, FAILING):
        axes.axhline(level, color="#9aa1ad", lw=0.8, ls=(0, (2, 3)))
    axes.set_ylim(-0.03, 0.75)
    dress(axes, title, "exploration", np.arange(1.0, len(longest) + 1.0))
    axes.set_xlim(0.5, max(len(longest), 4) + 0.5)
    axes.set_ylabel("activity x", fontsize=8)
    axes.xaxis.get_major_locator().set_params(integer=True)


def picture(starts: int = STARTS) -> bytes:
    """The figure as PNG."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11, 6.4), dpi=120, facecolor="white", layout="tight")
    axes = figure.subplots(2, 2)
    rows: tuple[tuple[str, PlannerSettings, int, int], ...] = (
        ("random-RNN", RandomRnn(), starts, 20_000),
        ("as printed, I = failure", PaperRnn(feed="failure"), min(starts, 5), 60),
    )
    for row, (name, settings, count, budget) in enumerate(rows):
        for column, scenario in enumerate(SCENARIOS):
            curves = activities(scenario, settings, count, budget)
            title = f"{name}, scenario {column + 1} ({scenario}), {count} starts"
            panel(axes[row][column], curves, title)
    raw = io.BytesIO()
    figure.savefig(raw, format="png")
    return raw.getvalue()


def main(argv: Sequence[str] | None = None) -> Path:
    """Write ``figure_5.png`` and return its path."""
    return write(picture, "figure_5", argv)


if __name__ == "__main__":
    sys.exit(ended(main))
