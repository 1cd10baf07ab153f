"""Colours that picture and page share."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

START, END, TARGET, OBSTACLE = "#aab2bf", "#3b6fb6", "#c0233b", "#c96f4a"
NEAREST, TREES = "#d11f8d", {"start": "#2a9d8f", "goal": "#8a5cc7"}
PLATE, SHELL, GRID = "#6b7280", "#8893a5", "#d5d9e0"


def rgb(colour: str) -> tuple[int, int, int]:
    """Red, green and blue, 0 to 255, of "#rrggbb"."""
    return int(colour[1:3], 16), int(colour[3:5], 16), int(colour[5:7], 16)


def time_colours(count: int) -> Array:
    """Colours of ``count`` instants from first to last, (count, 4)."""
    from matplotlib import colormaps

    shades: Array = np.asarray(colormaps["plasma"](np.linspace(0.05, 0.88, count)))
    return shades
