"""The looks that all charts share: ink, grid, curves, the frame of the axes."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

INK = "#2b2f38"
GRID = "#e3e6ec"
LIMIT = "#c0392b"
CURVES = ("#3b6fb6", "#e08b2d", "#4a9d6e", "#b5527d", "#7a68b3", "#8a6d4b", "#4aa5b5")


def dress(axes: Any, title: str, below: str, over: Array) -> None:
    """Give a chart its title, its axis label and the common looks."""
    axes.set_title(title, loc="left", fontsize=9, color=INK, pad=5)
    axes.set_xlabel(below, fontsize=7.5, color=INK, labelpad=2)
    if len(over) > 1:
        axes.set_xlim(over[0], over[-1])
    axes.tick_params(labelsize=7, colors=INK, length=2.5)
    axes.grid(True, color=GRID, lw=0.6)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    for side in ("left", "bottom"):
        axes.spines[side].set_color("#9aa1ad")
