"""Figure 3: the tracking errors of four schemes at three noise levels.

    python -m rrnn_opt.validation.figures.figure_3 --out DIR

Rows are the noise levels, columns the schemes of the paper's figure, in its
order: Methods 1 to 3 and the proposed law as printed; task, noise and its
entry are those of Table II (``tables.tracking``), circle A and one seed.
"""

from __future__ import annotations

import argparse
import io
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from rrnn_opt.report.axes import CURVES
from rrnn_opt.report.files import write_bytes
from rrnn_opt.simulation import SimulationResult
from rrnn_opt.validation.ending import ended
from rrnn_opt.validation.tables.tracking import ENTRIES, SIGMAS, Runner

COLUMNS = ("method1", "method2", "method3", "proposed")
CIRCLE = "A"
GAINS: Mapping[str, Mapping[str, float]] = {"method3": {"k0": 20.0, "k1": 100.0}}
"""Gains of the schemes that need some: those that they come with."""

PROGRAM = "python -m rrnn_opt.validation.figures.figure_3"


def runs(seed: int = 0) -> dict[tuple[str, float], SimulationResult]:
    """The twelve runs.

    Args:
        seed: of the noise.
    """
    runners = {key: Runner(ENTRIES[key], GAINS.get(key, {})) for key in COLUMNS}
    return {
        (key, sigma): runner.run(CIRCLE, sigma, seed)
        for sigma in SIGMAS
        for key, runner in runners.items()
    }


def draw(found: Mapping[tuple[str, float], SimulationResult]) -> bytes:
    """The twelve panels as a PNG.

    Args:
        found: of ``runs``.
    """
    from matplotlib.figure import Figure

    figure = Figure(figsize=(13.0, 8.0), dpi=120, layout="constrained")
    axes = figure.subplots(len(SIGMAS), len(COLUMNS), sharex=True)
    for i, sigma in enumerate(SIGMAS):
        for j, key in enumerate(COLUMNS):
            letter = chr(ord("a") + i * len(COLUMNS) + j)
            title = f"({letter}) {ENTRIES[key].label}, sigma = {sigma:g} rad/s"
            _panel(axes[i][j], found[key, sigma], title)
    for axis in axes[-1]:
        axis.set_xlabel("time [s]")
    for row in axes:
        row[0].set_ylabel("tip error [mm]")
    axes[0][0].legend(("x", "y", "z"), fontsize=7, loc="lower left", ncols=3)
    image = io.BytesIO()
    figure.savefig(image, format="png", metadata={"Software": None})
    return image.getvalue()


def _panel(axis: Any, run: SimulationResult, title: str) -> None:
    """The three components of the error over time; its mean in the title."""
    for k in range(3):
        axis.plot(run.t, 1e3 * run.error[:, k], lw=0.8, color=CURVES[k])
    axis.set_title(f"{title}\nRMS {1e3 * run.rms_error_m:.2f} mm", fontsize=8)
    axis.axhline(0.0, color="#b5bac4", lw=0.6)
    axis.margins(x=0.0)
    axis.tick_params(labelsize=7)
    largest = 1.1e3 * float(np.abs(run.error).max())
    axis.set_ylim(-largest, largest)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run and write ``figure_3.png``.

    Args:
        arguments: of the command line.
    """
    parser = argparse.ArgumentParser(prog=PROGRAM, description="Figure 3.")
    parser.add_argument("--seed", type=int, default=0, help="of the noise")
    parser.add_argument("--out", type=Path, required=True, help="folder of the PNG")
    given = parser.parse_args(arguments)
    given.out.mkdir(parents=True, exist_ok=True)
    print(write_bytes(given.out / "figure_3.png", draw(runs(given.seed))))
    return 0


if __name__ == "__main__":
    sys.exit(ended(main))
