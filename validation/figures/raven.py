"""The instrument of the Raven II enters the box: outside, and through the opening.

    python -m rrnn_opt.validation.figures.raven --out docs/images/raven.png

After Figure 6 of Li, Li and Hannaford 2019, doi 10.1109/TII.2018.2869588.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.planning import Problem, plan
from rrnn_opt.report.plan.camera import View
from rrnn_opt.report.plan.picture import draw_scene
from rrnn_opt.scene.library import scenario
from rrnn_opt.validation.ending import ended

START, SEED = 8, 8
CLOSE = 0.17
"""Width of the close view, m."""


def draw(path: Path) -> None:
    """Plan once and draw it twice.

    Args:
        path: PNG to write.
    """
    from matplotlib.figure import Figure

    problem = Problem.from_dict(scenario("raven_opening").problem(START))
    document = plan(problem, seed=SEED, keep_trees=True).to_dict()
    figure = Figure(figsize=(12.0, 5.2), dpi=110, facecolor="white")
    left, right = figure.subplots(1, 2, width_ratios=(1.0, 1.15))
    figure.subplots_adjust(0.01, 0.02, 0.99, 0.91, wspace=0.03)
    draw_scene(left, document, view=View(18.0, 20.0))
    draw_scene(right, _open(document), view=View(22.0, 8.0), focus=(_middle(), CLOSE))
    left.set_title("the shaft turns about the remote centre", fontsize=11, loc="left")
    right.set_title(
        "into the box through the 4 cm opening (one side left out)",
        fontsize=11,
        loc="left",
    )
    figure.savefig(path)


def _middle() -> Any:
    boards = scenario("raven_opening").obstacles
    return np.mean([board["position"] for board in boards], axis=0)


def _open(document: dict[str, Any]) -> dict[str, Any]:
    """The document without the board that would hide the inside."""
    problem = document["problem"]
    boards = [o for o in problem["obstacles"] if o["name"] != "side above"]
    return {**document, "problem": {**problem, "obstacles": boards}}


def main(argv: Sequence[str] | None = None) -> int:
    """Draw the figure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, required=True)
    draw(parser.parse_args(argv).out)
    return 0


if __name__ == "__main__":
    sys.exit(ended(main))
